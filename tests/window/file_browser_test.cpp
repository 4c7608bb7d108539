// What the file browser shows of a folder, and which file is meant.

#include "app/file_browser.h"
#include "io/format.h"
#include "support/scratch_folder.h"

#include <gtest/gtest.h>

#include <fstream>

namespace knead::test {

namespace {

class Browsing : public ::testing::Test {
protected:
    void SetUp() override {
        for (const char* name : {"Bunny.ply", "bunny bent.knead", "dragon.ply", "notes.pdf"})
            std::ofstream(folder_ / name) << "x";
        std::filesystem::create_directory(folder_ / "old bunnies");
        go_to(browser_, folder_.path());
    }
    std::vector<std::string> shown() const {
        std::vector<std::string> names;
        for (const int number : shown_entries(browser_))
            names.push_back(browser_.entries[static_cast<std::size_t>(number)].name);
        return names;
    }
    void type(const std::string& text) {
        browser_.typed = text;
        name_typed(browser_);
    }

    ScratchFolder folder_;
    FileBrowser browser_;
};

TEST_F(Browsing, ShowsWhatHasTheTypedTextInItsName) {
    EXPECT_EQ(shown(),
              (std::vector<std::string>{"old bunnies", "bunny bent.knead", "Bunny.ply", "dragon.ply"}));
    type("bUN");
    EXPECT_EQ(shown(), (std::vector<std::string>{"old bunnies", "bunny bent.knead", "Bunny.ply"}));
    type("tree");
    EXPECT_TRUE(shown().empty());
    go_to(browser_, folder_ / "old bunnies");
    EXPECT_TRUE(browser_.filter.empty()) << "another folder, another look";
}

TEST_F(Browsing, FollowsAPathThatIsTyped) {
    std::ofstream(folder_ / "old bunnies" / "first.ply") << "x";
    type((folder_ / "old bunnies" / "fi").string());
    EXPECT_EQ(browser_.folder, folder_ / "old bunnies");
    EXPECT_EQ(shown(), std::vector<std::string>{"first.ply"});
    EXPECT_EQ(chosen_path(browser_), folder_ / "old bunnies" / "first.ply");
    type("/nowhere/at/all");
    EXPECT_EQ(browser_.folder, folder_ / "old bunnies") << "there is no such folder";
}

TEST_F(Browsing, ShowsAllWhereSomethingIsSaved) {
    browser_.purpose = BrowseFor::save_cloud;
    type("dragon 2");
    EXPECT_TRUE(browser_.filter.empty());
}

TEST_F(Browsing, AddsTheExtensionThatANameWithADotLacks) {
    const auto chosen = [&](BrowseFor purpose, const char* typed) {
        browser_.purpose = purpose;
        type(typed);
        return chosen_path(browser_).filename();
    };
    EXPECT_EQ(chosen(BrowseFor::save_session, "walk 1.2"), "walk 1.2.knead");
    EXPECT_EQ(chosen(BrowseFor::save_session, "walk.knead"), "walk.knead");
    EXPECT_EQ(chosen(BrowseFor::save_cloud, "bunny v1.2"), "bunny v1.2.ply");
    EXPECT_EQ(chosen(BrowseFor::save_cloud, "bunny"), "bunny.ply");
    EXPECT_EQ(chosen(BrowseFor::save_cloud, "bunny.stl"), "bunny.stl") << "which is refused with words";
}

TEST_F(Browsing, MeansTheOnlyOneThatIsLeft) {
    type("drag");
    EXPECT_EQ(chosen_path(browser_).filename(), "dragon.ply");
    type("bunny");
    EXPECT_EQ(chosen_path(browser_).filename(), "bunny") << "several: the name as it was typed";
    type("notes.pdf");
    EXPECT_EQ(chosen_path(browser_).filename(), "notes.pdf") << "it is there, though not shown";
    type("");
    browser_.typed = "drag"; // by other means
    EXPECT_EQ(chosen_path(browser_).filename(), "drag") << "nothing was looked for";
}

TEST_F(Browsing, KnowsTheFormatThatANameMeans) {
    browser_.purpose = BrowseFor::save_cloud;
    const auto meant = [&](const char* typed) {
        type(typed);
        const Format* format = meant_format(browser_);
        return format ? format->name : "none";
    };
    EXPECT_EQ(meant("bunny.las"), "las");
    EXPECT_EQ(meant("Bunny.LAS"), "las");
    EXPECT_EQ(meant("bunny.asc"), "txt");
    EXPECT_EQ(meant("bunny v1.2"), "ply");
    EXPECT_EQ(meant("bunny.stl"), "none");
    EXPECT_EQ(meant(""), "ply") << "what a name would mean";
    EXPECT_EQ(meant("old bunnies"), "ply");
}

TEST_F(Browsing, GivesANameTheExtensionOfTheChosenFormat) {
    browser_.purpose = BrowseFor::save_cloud;
    const auto renamed = [&](const std::string& typed, const char* extension) {
        browser_.name_changed_outside = false;
        type(typed);
        take_format(browser_, *format_with_extension(std::string("a") + extension));
        return browser_.typed;
    };
    EXPECT_EQ(renamed("bunny.ply", ".las"), "bunny.las");
    EXPECT_TRUE(browser_.name_changed_outside);
    EXPECT_EQ(renamed("~/scans/bunny.PLY", ".xyz"), "~/scans/bunny.xyz");
    EXPECT_EQ(renamed("bunny v1.2", ".pcd"), "bunny v1.2.pcd");
    EXPECT_EQ(renamed("bunny", ".txt"), "bunny.txt");
    EXPECT_EQ(renamed("bunny.stl", ".obj"), "bunny.obj");
    type("dragon 2"); // with none, after a choice
    EXPECT_EQ(chosen_path(browser_).filename(), "dragon 2.obj");
}

TEST_F(Browsing, LeavesAFolderItsNameWhateverTheFormat) {
    browser_.purpose = BrowseFor::save_cloud;
    browser_.name_changed_outside = false;
    for (const char* typed : {"", "old bunnies", "somewhere/"}) {
        type(typed);
        take_format(browser_, *format_with_extension("a.las"));
        EXPECT_EQ(browser_.typed, typed);
        EXPECT_FALSE(browser_.name_changed_outside) << typed;
    }
    EXPECT_EQ(meant_format(browser_)->name, "las");
}

} // namespace

} // namespace knead::test

// What the file browser shows of a folder, and which file is meant.

#include "app/file_browser.h"
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

} // namespace

} // namespace knead::test

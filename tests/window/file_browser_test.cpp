// What the file browser shows of a folder, and which file is meant.

#include "app/file_browser.h"
#include "app/ui.h"
#include "io/format.h"
#include "support/scratch_folder.h"
#include "window/panel.h"

#include <fstream>
#include <string_view>

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

TEST_F(Browsing, ShowsThePicturesWhereOneIsSaved) {
    std::ofstream(folder_ / "view.png") << "x";
    browser_.purpose = BrowseFor::save_picture;
    read_folder(browser_);
    EXPECT_EQ(shown(), (std::vector<std::string>{"old bunnies", "view.png"}));
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
    EXPECT_EQ(chosen(BrowseFor::save_picture, "view 1.2"), "view 1.2.png");
    EXPECT_EQ(chosen(BrowseFor::save_picture, "view.PNG"), "view.PNG");
    EXPECT_EQ(chosen(BrowseFor::save_picture, "bunny.ply"), "bunny.ply.png");
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

TEST_F(Browsing, MakesAFolderAndGoesThere) {
    ASSERT_TRUE(make_folder(browser_, "bent"));
    EXPECT_EQ(browser_.folder, folder_ / "bent");
    EXPECT_TRUE(browser_.entries.empty());
    EXPECT_TRUE(browser_.trouble.empty());
}

TEST_F(Browsing, SaysWhyAFolderCannotBeMade) {
    for (const char* name : {"old bunnies", "dragon.ply", "nowhere/at all"}) {
        EXPECT_FALSE(make_folder(browser_, name)) << name;
        EXPECT_NE(browser_.trouble.find(name), std::string::npos) << browser_.trouble;
        EXPECT_EQ(browser_.folder, folder_.path());
    }
    EXPECT_NE(browser_.trouble.find("No such file or directory"), std::string::npos) << browser_.trouble;
}

TEST_F(Browsing, MakesTheFoldersThatATypedPathLacks) {
    browser_.missing_folder = folder_ / "one" / "other";
    make_missing_folder(browser_);
    EXPECT_TRUE(std::filesystem::is_directory(folder_ / "one" / "other"));
    EXPECT_TRUE(browser_.trouble.empty());
    EXPECT_TRUE(browser_.missing_folder.empty());
    EXPECT_EQ(shown().front(), "old bunnies");
    EXPECT_EQ(shown().at(1), "one");
    browser_.missing_folder = folder_ / "dragon.ply" / "inside";
    make_missing_folder(browser_);
    EXPECT_FALSE(browser_.trouble.empty());
}

// The dialog that saves a session, in a window of 1000 by 700.
class SavingDialog : public Panel {
protected:
    void SetUp() override {
        Panel::SetUp();
        ImGui::GetIO().DisplaySize = {1000, 700};
        state_.fonts = fonts_;
        browser_.purpose = BrowseFor::save_session;
        browser_.folder = folder_.path();
        browser_.typed = "walk.knead";
        browser_.open_now = true;
        frames(4);
    }
    void draw() override { draw_file_browser({editor_, state_, commands_, wishes_}); }

    void click_new_folder() {
        const ImGuiWindow& dialog = *ImGui::FindWindowByName("browser");
        const ImGuiStyle& style = ImGui::GetStyle();
        click({dialog.Pos.x + dialog.Size.x - style.WindowPadding.x - 20,
               dialog.Pos.y + style.WindowPadding.y + fonts_.title->FontSize + style.ItemSpacing.y +
                   ImGui::GetFrameHeight() / 2});
        frames(3);
    }
    void type(std::string_view text) {
        for (const char letter : text) {
            ImGui::GetIO().AddInputCharacter(static_cast<unsigned>(letter));
            frame();
        }
    }

    ScratchFolder folder_;
    Editor editor_{1};
    UiState state_;
    FileBrowser& browser_ = state_.browser;
    std::vector<Command> commands_;
    std::vector<Wish> wishes_;
};

TEST_F(SavingDialog, MakesAFolderThatIsNamedInPlace) {
    ASSERT_TRUE(browser_.is_open);
    click_new_folder();
    ASSERT_TRUE(browser_.new_folder.asked_for);
    type("walks");
    press(ImGuiKey_Enter);
    EXPECT_TRUE(std::filesystem::is_directory(folder_ / "walks"));
    EXPECT_EQ(browser_.folder, folder_ / "walks");
    EXPECT_FALSE(browser_.new_folder.asked_for);
    EXPECT_EQ(browser_.typed, "walk.knead") << "the file keeps its name";
    EXPECT_TRUE(wishes_.empty()) << "nothing is saved by that Enter";
    frames(3);
    press(ImGuiKey_Enter); // but by the next one
    ASSERT_EQ(wishes_.size(), 1U);
    EXPECT_EQ(std::get<WishSaveTo>(wishes_.front()).file, folder_ / "walks" / "walk.knead");
}

TEST_F(SavingDialog, EscapeGivesUpTheNameOfAFolderAndNotTheDialog) {
    click_new_folder();
    type("walks");
    press(ImGuiKey_Escape);
    EXPECT_FALSE(browser_.new_folder.asked_for);
    EXPECT_TRUE(browser_.is_open);
    frames(3);
    press(ImGuiKey_Escape);
    EXPECT_FALSE(browser_.is_open);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "walks"));
}

TEST_F(SavingDialog, TheNameOfAFolderThatCannotBeMadeStaysToBeMended) {
    std::filesystem::create_directory(folder_ / "walks");
    click_new_folder();
    type("walks");
    press(ImGuiKey_Enter);
    EXPECT_FALSE(browser_.trouble.empty());
    EXPECT_TRUE(browser_.new_folder.asked_for);
    EXPECT_EQ(browser_.folder, folder_.path());
    frames(3);
    type("runs"); // instead of it
    press(ImGuiKey_Enter);
    EXPECT_EQ(browser_.folder, folder_ / "runs");
    EXPECT_TRUE(browser_.trouble.empty());
}

TEST_F(SavingDialog, ATypedPathWhoseFolderIsMissingOffersToMakeIt) {
    browser_.typed = (folder_ / "missing" / "walk.knead").string();
    browser_.name_changed_outside = true;
    frames(3);
    press(ImGuiKey_Enter);
    EXPECT_EQ(browser_.missing_folder, folder_ / "missing");
    EXPECT_TRUE(wishes_.empty());
    make_missing_folder(browser_); // what the button does
    frames(3);
    press(ImGuiKey_Enter);
    EXPECT_EQ(wishes_.size(), 1U);
}

} // namespace

} // namespace knead::test

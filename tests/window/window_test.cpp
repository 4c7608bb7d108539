// The real window, worked by a real hand: real X events on a display of the test's own.

#include "edit/session.h"
#include "io/cloud_file.h"
#include "support/run_knead.h"
#include "support/scratch_folder.h"
#include "support/turned_cloud.h"
#include "view/framing.h"
#include "window/desktop.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>

namespace knead::test {

namespace {

// Where the cloud is drawn in a window of 1280 x 800 (src/app/loop_drawing.cpp lays it out); a few pixels
// more or less do not matter here.
constexpr double view_left = 52, view_top = 30;
constexpr Viewport viewport{1280 - 52 - 310, 800 - 30 - 28};

using Path = std::vector<std::pair<double, double>>;

class WindowTest : public ::testing::Test {
protected:
    void SetUp() override {
        std::string why;
        desktop_ = Desktop::start(folder_.path(), why);
        if (!desktop_) GTEST_SKIP() << why;
        const Outcome made = run_knead({"make", "creature", "--points", "8000", "--outliers", "0", "--out",
                                        (folder_ / "cat.ply").string()});
        ASSERT_EQ(made.code, 0) << made.err;
        SilentProgress silent;
        cloud_ = read_cloud(folder_ / "cat.ply", silent);
        // As the keys 3 and Home make it: it looks the cat in the face.
        look_at_side(camera_, Side::right);
        frame(camera_, bulk_box(cloud_.positions), viewport);
    }

    void open_cat() {
        editor_ = desktop_->open_editor({(folder_ / "cat.ply").string()});
        ASSERT_TRUE(desktop_->wait_for_title("cat.ply")) << read_text(folder_ / "editor.log");
        desktop_->focus();
        pause(0.5);
    }

    // Where a point of the cloud, in the file's coordinates, is on the screen.
    std::pair<double, double> on_screen(double x, double y, double z) const {
        const Vec3d p = Vec3d(x, y, z) - cloud_.origin;
        const glm::dvec2 pixel = project(camera_, viewport, {p.x(), p.y(), p.z()})->pixel;
        return {view_left + pixel.x, view_top + pixel.y};
    }

    // Round a rectangle of the plane through the cat's middle.
    Path round(double y_from, double y_to, double z_from, double z_to) const {
        return {on_screen(0, y_from, z_from), on_screen(0, y_to, z_from), on_screen(0, y_to, z_to),
                on_screen(0, y_from, z_to), on_screen(0, y_from, z_from)};
    }

    // Head and feet become handles, as an artist would do it.
    void make_handles() {
        desktop_->drag(2, {{500, 400}, {560, 420}, {640, 400}}); // looks round first
        desktop_->keys({"3", "Home", "t"});
        desktop_->drag(1, round(-0.55, 0.55, 1.2, 1.85));
        desktop_->keys({"h"});
        ASSERT_TRUE(wait_for_act("handle", 1));
        desktop_->drag(1, round(-0.6, 0.6, -0.1, 0.25));
        desktop_->keys({"shift+h"});
        ASSERT_TRUE(wait_for_act("handle", 2));
    }

    void turn_a_cats_head() {
        open_cat();
        make_handles();
        desktop_->move(500, 300);
        desktop_->keys({"r", "3", "0", "Return"});
        ASSERT_TRUE(wait_for_act("settle", 1));
    }

    // What has been recorded so far.
    std::string recording() const {
        std::error_code none;
        for (const auto& entry : std::filesystem::directory_iterator(desktop_->state_folder(), none))
            if (entry.path().extension() == ".knead") return read_text(entry.path());
        return {};
    }
    std::size_t acts(const std::string& op) const {
        const std::string text = recording(), key = "{\"op\":\"" + op + "\"";
        std::size_t count = 0;
        for (std::size_t at = text.find(key); at != std::string::npos; at = text.find(key, at + 1)) ++count;
        return count;
    }
    bool wait_for_act(const std::string& op, std::size_t count) const {
        return wait_until([&] { return acts(op) >= count; });
    }

    void save(const char* shortcut, const std::filesystem::path& target) {
        desktop_->keys({shortcut});
        pause(1);
        desktop_->type(target.string());
        desktop_->keys({"Return"});
        ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(target); })) << target;
        pause(0.3);
    }

    // What the view shows. `name`: without ".png" or with it, which is added.
    void save_picture(const std::string& name) {
        desktop_->move(640, 600); // off the menus
        desktop_->keys({"F10", "Up", "Up", "Up", "Up", "Return"});
        pause(1);
        desktop_->type(name);
        desktop_->keys({"Return"});
    }

    void expect_equal_shapes(const std::filesystem::path& session, const std::filesystem::path& saved) {
        const std::string replayed = (folder_ / "replayed.ply").string();
        const Outcome replay = run_knead({"replay", session.string(), "--out", replayed});
        ASSERT_EQ(replay.code, 0) << replay.err;
        const Outcome diff = run_knead({"diff", saved.string(), replayed, "--json"});
        ASSERT_EQ(diff.code, 0) << diff.err;
        EXPECT_LE(nlohmann::json::parse(diff.out).at("largest").get<double>(), 1e-6);
        const Outcome moved = run_knead({"diff", saved.string(), (folder_ / "cat.ply").string(), "--json"});
        EXPECT_GT(nlohmann::json::parse(moved.out).at("largest").get<double>(), 0.01);
    }

    ScratchFolder folder_;
    std::optional<Desktop> desktop_;
    Process editor_;
    PointCloud cloud_;
    Camera camera_;
};

} // namespace

TEST_F(WindowTest, PosesSavesAndRecordsWhatReplaysToTheSameShape) {
    open_cat();
    make_handles();
    desktop_->move(500, 300);
    desktop_->keys({"r", "x", "4", "5", "Return"});
    ASSERT_TRUE(wait_for_act("settle", 1));
    EXPECT_EQ(acts("drag"), 1U);
    EXPECT_NE(desktop_->title().find("*"), std::string::npos);
    desktop_->keys({"Return"});
    ASSERT_TRUE(wait_for_act("commit", 1));
    desktop_->keys({"ctrl+z", "ctrl+z"});
    ASSERT_TRUE(wait_for_act("undo", 3)); // the commit; the drag with its settling
    desktop_->keys({"ctrl+shift+z"});
    ASSERT_TRUE(wait_for_act("redo", 2));

    // And a second drag, along the cursor's own way: G, motions of the mouse, and a click to confirm.
    desktop_->move(500, 300);
    desktop_->keys({"g"});
    for (int step = 1; step <= 10; ++step) desktop_->move(500 + 6 * step, 300 - 3 * step);
    desktop_->drag(1, {{560, 270}});
    ASSERT_TRUE(wait_for_act("drag", 2));
    ASSERT_TRUE(wait_for_act("settle", 2));

    save("ctrl+e", folder_ / "kept.ply");
    EXPECT_NE(desktop_->title().find("*"), std::string::npos) << "an exported cloud is no session";
    save("ctrl+s", folder_ / "kept.knead");
    EXPECT_EQ(desktop_->title().find("*"), std::string::npos);
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
    EXPECT_TRUE(recording().empty()) << "nothing is left to restore";

    const Session session = read_session(folder_ / "kept.knead");
    const auto& head = std::get<HandleLine>(session.lines.at(0).action);
    std::size_t points = 0;
    for (const IndexRange& range : std::get<std::vector<IndexRange>>(head.points))
        for (std::size_t i = range.first; i <= range.last; ++i, ++points)
            EXPECT_GT(cloud_.file_position(i).z(), 1.1) << "the lasso went round the head alone";
    EXPECT_GT(points, 500U);
    expect_equal_shapes(folder_ / "kept.knead", folder_ / "kept.ply");
}

// The window is as large as the screen: there the cursor comes in again on the other side.
TEST_F(WindowTest, AMoveDoesNotEndAtTheWindowsEdge) {
    open_cat();
    make_handles();
    desktop_->move(500, 300);
    desktop_->keys({"g"});
    for (int step = 0; step < 40; ++step) desktop_->move_on(75, 0); // wider than the screen twice over
    desktop_->move_on(0, 100);
    desktop_->keys({"Return"});
    ASSERT_TRUE(wait_for_act("settle", 1));
    save("ctrl+s", folder_ / "moved.knead");
    const auto [left, top] = on_screen(0, 0, 1.5);
    const auto [right, bottom] = on_screen(0, 1, 0.5);
    const Session session = read_session(folder_ / "moved.knead");
    const HandlePose& pose = std::get<DragLine>(session.lines.at(2).action).frames.back();
    EXPECT_NEAR(pose.translate.y(), 3000 / (right - left), 0.1 * 3000 / (right - left));
    EXPECT_NEAR(pose.translate.z(), -100 / (bottom - top), 0.2 * 100 / (bottom - top));
}

TEST_F(WindowTest, LookingAtTheTimelineLeavesWhatWasUndoneUndone) {
    turn_a_cats_head();
    desktop_->keys({"ctrl+z"});
    ASSERT_TRUE(wait_for_act("undo", 2)); // the drag with its settling
    save("ctrl+e", folder_ / "before.ply");
    desktop_->keys({"Left"});
    pause(0.5);
    desktop_->keys({"Escape"});
    pause(0.5);
    save("ctrl+e", folder_ / "after.ply");
    EXPECT_EQ(read_text(folder_ / "before.ply"), read_text(folder_ / "after.ply"));
    EXPECT_EQ(acts("redo"), 0U);
}

TEST_F(WindowTest, LookingAtTheLastStepFrameByFrameLeadsBackToItsEnd) {
    turn_a_cats_head();
    save("ctrl+e", folder_ / "before.ply");
    desktop_->keys({"Left", "Left", "Left"});
    pause(0.5);
    save("ctrl+e", folder_ / "amid.ply");
    desktop_->keys({"Escape"});
    pause(0.5);
    save("ctrl+e", folder_ / "after.ply");
    EXPECT_NE(read_text(folder_ / "before.ply"), read_text(folder_ / "amid.ply"));
    EXPECT_EQ(read_text(folder_ / "before.ply"), read_text(folder_ / "after.ply"));
}

TEST_F(WindowTest, WhatAKillLeavesIsRestored) {
    turn_a_cats_head();
    desktop_->keys({"g"}); // and is killed in mid-drag
    for (int step = 1; step <= 5; ++step) desktop_->move(500 + 10 * step, 300);
    editor_.kill_hard();
    const std::string left = recording();
    EXPECT_EQ(acts("drag"), 1U);
    write_text(folder_ / "left.knead", left);

    editor_ = desktop_->open_editor({});
    ASSERT_TRUE(desktop_->wait_for_title("knead"));
    desktop_->focus();
    pause(1);
    desktop_->keys({"Return"}); // Restore
    ASSERT_TRUE(desktop_->wait_for_title("cat.ply*")) << read_text(folder_ / "editor.log");
    pause(0.5);
    save("ctrl+e", folder_ / "restored.ply");
    expect_equal_shapes(folder_ / "left.knead", folder_ / "restored.ply");
    save("ctrl+s", folder_ / "restored.knead");
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

TEST_F(WindowTest, AsksBeforeItOverwritesWhatSomebodyElseSaved) {
    open_cat();
    make_handles();
    const std::filesystem::path session = folder_ / "kept.knead";
    save("ctrl+s", session);
    const std::string theirs = read_text(session) + "\n";
    write_text(session, theirs);
    desktop_->keys({"ctrl+s"});
    pause(1);
    EXPECT_EQ(read_text(session), theirs);
    desktop_->keys({"Escape"}); // gives up
    pause(1);
    EXPECT_EQ(read_text(session), theirs);
    std::filesystem::remove(session); // there is nothing to lose any more, and nothing to ask
    desktop_->keys({"ctrl+s"});
    pause(1);
    EXPECT_GE(read_session(session).lines.size(), 2U);
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

// They write into what the window's thread has freed (src/cli/main.cpp).
TEST_F(WindowTest, LlvmpipeDrawsWithNoThreadsOfItsOwn) {
    open_cat();
    const std::vector<std::string> threads = editor_.threads();
    EXPECT_GE(threads.size(), 2U) << "the window's and the document's";
    for (const std::string& name : threads) EXPECT_FALSE(name.starts_with("llvmpipe")) << name;
}

// All at once: the document has not answered the first key when the others come.
TEST_F(WindowTest, KeysThatComeAheadOfTheDocumentActInTheirOrder) {
    open_cat();
    make_handles();
    desktop_->drag(1, round(-0.2, 0.2, 0.7, 1.0));
    desktop_->burst({"h", "g", "z", "0", "period", "1", "Return"});
    ASSERT_TRUE(wait_for_act("handle", 3));
    ASSERT_TRUE(wait_for_act("drag", 1));
    // About the place where the handle is once the move is taken back.
    desktop_->burst({"ctrl+z", "r", "z", "3", "0", "Return"});
    ASSERT_TRUE(wait_for_act("drag", 2));
    const std::string text = recording();
    const auto pivot_at = [&](std::size_t drag) {
        const std::size_t at = text.find("\"pivot\"", drag);
        return text.substr(at, text.find(']', at) - at);
    };
    EXPECT_EQ(pivot_at(text.find(R"({"op":"drag")")), pivot_at(text.rfind(R"({"op":"drag")")));
    desktop_->keys({"ctrl+q", "Tab", "Return"}); // Discard
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

TEST_F(WindowTest, WhatIsTypedCountsBeforeTheHandGoesOn) {
    open_cat();
    make_handles();
    desktop_->keys({"Tab", "F2"});
    pause(0.5);
    desktop_->type("neck");
    desktop_->keys({"ctrl+o"}); // without Enter
    pause(0.7);
    desktop_->keys({"Escape"});
    EXPECT_TRUE(wait_for_act("rename", 1));
    pause(0.7); // the dialog is gone
    desktop_->keys({"F2"});
    pause(0.7);
    desktop_->type("sole");
    desktop_->drag(1, round(-0.2, 0.2, 0.7, 1.0)); // nor here
    desktop_->keys({"h"});
    ASSERT_TRUE(wait_for_act("handle", 3));
    EXPECT_EQ(acts("rename"), 2U);
    const std::string text = recording();
    EXPECT_LT(text.find("\"sole\""), text.rfind(R"({"op":"handle")")) << "first the name";
    desktop_->keys({"ctrl+q", "Tab", "Return"}); // Discard
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

TEST_F(WindowTest, ASecondButtonLeavesTheFirstOneAtWork) {
    open_cat();
    desktop_->keys({"3", "Home", "t"});
    const Path path = round(-0.55, 0.55, 1.2, 1.85);
    desktop_->move(path.front().first, path.front().second);
    desktop_->press(1);
    for (const auto& [x, y] : path) desktop_->move(x, y);
    desktop_->press(2);
    desktop_->release(2);
    desktop_->release(1); // which ends the lasso: H is heard
    desktop_->keys({"h"});
    EXPECT_TRUE(wait_for_act("handle", 1));
    // And the other way round: a click in the middle of an orbit.
    desktop_->move(500, 400);
    desktop_->press(2);
    desktop_->move(540, 410);
    desktop_->press(1);
    desktop_->release(1);
    desktop_->release(2);
    desktop_->keys({"r", "3", "0", "Return"});
    EXPECT_TRUE(wait_for_act("drag", 1));
}

TEST_F(WindowTest, MenusAndQuestionsGoByTheKeyboard) {
    open_cat();
    make_handles();
    desktop_->move(640, 600);                           // off the menus
    desktop_->keys({"F10", "Right", "Down", "Return"}); // Edit, Undo
    EXPECT_TRUE(wait_for_act("undo", 1));
    desktop_->keys({"F10", "Left", "Right", "Up", "Return"}); // File, Quit
    pause(1);
    EXPECT_TRUE(editor_.runs()) << "it asks first";
    desktop_->keys({"Escape"});
    pause(0.5);
    EXPECT_TRUE(editor_.runs());
    desktop_->keys({"ctrl+q", "Tab", "Return"}); // Discard
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
    EXPECT_TRUE(recording().empty());
}

TEST_F(WindowTest, TheRightButtonOpensAMenuOfWhatIsUnderTheCursor) {
    open_cat();
    desktop_->keys({"3", "Home", "t"});
    desktop_->drag(1, round(-0.55, 0.55, 1.2, 1.85));
    const auto [x, y] = round(-0.01, 0.01, 1.5, 1.52).front();
    const auto take_from_menu = [&](std::initializer_list<const char*> keys) {
        desktop_->move(x, y);
        desktop_->press(3);
        desktop_->release(3);
        desktop_->move(640, 760); // off the menu
        pause(0.5);
        desktop_->keys(keys);
    };
    take_from_menu({"Down", "Up", "Return"}); // of the selection: "Moving handle"
    EXPECT_TRUE(wait_for_act("handle", 1));
    take_from_menu({"Up", "Return"}); // of the handle: "Delete"
    EXPECT_TRUE(wait_for_act("delete", 1));
    // In the middle of a move it takes that back, and no menu opens.
    desktop_->keys({"ctrl+z"});
    EXPECT_TRUE(wait_for_act("undo", 1));
    desktop_->keys({"g"});
    desktop_->move(x + 40, y);
    desktop_->press(3);
    desktop_->release(3);
    desktop_->keys({"r", "3", "0", "Return"});
    EXPECT_TRUE(wait_for_act("drag", 1));
}

TEST_F(WindowTest, SavesAPictureOfTheViewAndGoesOn) {
    open_cat();
    desktop_->keys({"3", "Home"});
    const std::filesystem::path file = folder_ / "view.png";
    save_picture((folder_ / "view").string());
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(file); }))
        << read_text(folder_ / "editor.log");
    const std::string png = read_text(file);
    ASSERT_EQ(png.substr(1, 3), "PNG");
    const auto number_at = [&](std::size_t place) {
        int number = 0;
        for (std::size_t i = 0; i < 4; ++i)
            number = 256 * number + static_cast<unsigned char>(png[place + i]);
        return number;
    };
    EXPECT_EQ(number_at(16), 2 * viewport.width);
    EXPECT_NEAR(number_at(20), 2 * viewport.height, 20);

    // What is there is asked about: another name is what Enter means.
    pause(0.5);
    save_picture((folder_ / "view.png").string());
    pause(1);
    desktop_->keys({"Return"});
    pause(1);
    desktop_->type((folder_ / "other.png").string());
    desktop_->keys({"Return"});
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(folder_ / "other.png"); }));
    EXPECT_EQ(read_text(file), png);
    EXPECT_EQ(read_text(folder_ / "other.png"), png) << "the same view";

    pause(0.5);
    desktop_->keys({"1"});
    save_picture((folder_ / "side.png").string());
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(folder_ / "side.png"); }));
    EXPECT_NE(read_text(folder_ / "side.png"), png) << "another view";
    pause(0.5);
    save("ctrl+e", folder_ / "same.ply");
    EXPECT_EQ(read_text(folder_ / "same.ply"), read_text(folder_ / "cat.ply"));
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

TEST_F(WindowTest, ShowsTheCloudAsItWasOpenedUntilItIsMovedOn) {
    turn_a_cats_head();
    const auto seen = [&](const char* name) {
        const std::filesystem::path file = folder_ / name;
        pause(1);
        save_picture(file.string());
        EXPECT_TRUE(wait_until([&] { return std::filesystem::exists(file); })) << name;
        pause(0.5);
        return read_text(file);
    };
    const std::string posed = seen("posed.png");
    desktop_->keys({"o"});
    const std::string opened = seen("opened.png");
    EXPECT_NE(opened, posed);
    desktop_->keys({"o"});
    EXPECT_EQ(seen("again.png"), posed);
    desktop_->keys({"o"});
    pause(0.5);
    desktop_->move(500, 300);
    desktop_->keys({"r", "2", "0", "Return"});
    ASSERT_TRUE(wait_for_act("drag", 2));
    const std::string on = seen("on.png");
    EXPECT_NE(on, opened);
    EXPECT_NE(on, posed);
    EXPECT_EQ(acts("undo"), 0U);
}

TEST_F(WindowTest, ANameThatCannotBeSavedStaysToBeMended) {
    open_cat();
    make_handles();
    desktop_->keys({"ctrl+s"});
    pause(1);
    desktop_->type((folder_ / "missing" / "kept.knead").string());
    desktop_->keys({"Return"});
    pause(1);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "missing"));
    std::filesystem::create_directory(folder_ / "missing");
    desktop_->keys({"Return"}); // the dialog is still there, and the name in it
    ASSERT_TRUE(wait_until([&] { return std::filesystem::exists(folder_ / "missing" / "kept.knead"); }));
    pause(0.3);
    EXPECT_EQ(read_session(folder_ / "missing" / "kept.knead").lines.size(), 2U);
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

TEST_F(WindowTest, ASessionWhoseCloudWasMovedAsksWhereItIs) {
    const std::filesystem::path elsewhere = folder_ / "moved" / "elsewhere.ply";
    write_text(folder_ / "work.knead", R"({"knead":1,"cloud":{"path":"cat.ply"}})"
                                       "\n"
                                       R"({"op":"handle","name":"all","role":"fixed","region":"all"})"
                                       "\n");
    std::filesystem::create_directory(elsewhere.parent_path());
    std::filesystem::rename(folder_ / "cat.ply", elsewhere);
    editor_ = desktop_->open_editor({(folder_ / "work.knead").string()});
    ASSERT_TRUE(desktop_->wait_for_title("knead"));
    pause(1);
    desktop_->focus();
    desktop_->keys({"Return"}); // Choose the cloud…
    pause(1);
    desktop_->keys({"Escape"}); // thinks better of it; the question is still there
    pause(0.5);
    desktop_->keys({"Return"});
    pause(1);
    desktop_->type(elsewhere.string());
    desktop_->keys({"Return"});
    ASSERT_TRUE(desktop_->wait_for_title("work.knead")) << read_text(folder_ / "editor.log");
    desktop_->keys({"ctrl+s"});
    ASSERT_TRUE(
        wait_until([&] { return read_session(folder_ / "work.knead").cloud == "moved/elsewhere.ply"; }));
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

// A tube that stands along y: what the lasso goes round from the front is its upper end.
TEST_F(WindowTest, ACloudThatStandsAlongYIsUpright) {
    const std::filesystem::path made = folder_ / "made.ply", tube = folder_ / "tube.xyz";
    ASSERT_EQ(run_knead({"make", "cylinder", "--points", "5000", "--out", made.string()}).code, 0);
    SilentProgress silent;
    write_text(tube, turned_to_y(read_cloud(made, silent)));
    cloud_ = read_cloud(tube, silent);
    set_up(camera_, UpAxis::y);
    look_at_side(camera_, Side::front);
    frame(camera_, bulk_box(cloud_.positions), viewport);

    editor_ = desktop_->open_editor({tube.string()});
    ASSERT_TRUE(desktop_->wait_for_title("tube.xyz")) << read_text(folder_ / "editor.log");
    desktop_->focus();
    pause(0.5);
    desktop_->keys({"1", "Home", "t"});
    desktop_->drag(1, {on_screen(-0.8, 1.5, 0), on_screen(0.8, 1.5, 0), on_screen(0.8, 2.8, 0),
                       on_screen(-0.8, 2.8, 0), on_screen(-0.8, 1.5, 0)});
    desktop_->keys({"h"});
    ASSERT_TRUE(wait_for_act("handle", 1));
    save("ctrl+s", folder_ / "kept.knead");
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
    const Session session = read_session(folder_ / "kept.knead");
    const auto& end = std::get<HandleLine>(session.lines.at(0).action);
    std::size_t points = 0;
    for (const IndexRange& range : std::get<std::vector<IndexRange>>(end.points))
        for (std::size_t i = range.first; i <= range.last; ++i, ++points)
            EXPECT_GT(cloud_.file_position(i).y(), 1.4);
    EXPECT_GT(points, 500U);
}

TEST_F(WindowTest, StaysUsableWhereAFileCannotBeOpened) {
    editor_ = desktop_->open_editor({(folder_ / "nothing.ply").string()});
    ASSERT_TRUE(desktop_->wait_for_title("knead"));
    pause(1);
    desktop_->focus();
    EXPECT_TRUE(editor_.runs());
    desktop_->keys({"ctrl+q"});
    EXPECT_EQ(editor_.exit_code(20), 0) << read_text(folder_ / "editor.log");
}

TEST(Window, WithoutADisplayItSaysSo) {
    const ScratchFolder folder;
    Process editor({knead_binary().string(), "edit"}, {"DISPLAY="}, folder / "log");
    EXPECT_EQ(editor.exit_code(20), 2);
    EXPECT_NE(read_text(folder / "log").find("display"), std::string::npos) << read_text(folder / "log");
}

} // namespace knead::test

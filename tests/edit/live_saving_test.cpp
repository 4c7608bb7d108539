// What a live document keeps on disk: the journal, what is restored of it, and sessions that are saved.

#include "edit/live_document.h"

#include "edit/live_bar.h"
#include "io/digest.h"

#include <algorithm>

namespace knead::test {

std::vector<std::string> lines_in(const std::filesystem::path& session) {
    std::vector<std::string> lines;
    for (const SessionLine& line : read_session(session).lines) lines.push_back(to_text(line.action));
    return lines;
}

TEST_F(LiveBar, WhatACrashLeavesIsRestored) {
    const std::filesystem::path state = folder_ / "state";
    OpenRequest request = request_for(bar_file(folder_));
    request.journal_folder = state;
    PosedFrame posed;
    {
        LiveDocument live(request);
        wait_until_open(live);
        for (const SessionAction& handle : bar_handles()) live.post(++step_, {handle});
        live.begin_drag(++step_, "high", {0, 0, 2});
        live.drag_to(turned(1));
        live.end_drag();
        wait_until_idle(live);
        live.take_frame(posed);
        EXPECT_TRUE(find_lost_work(state).empty()) << "a recording that is open is not lost";
        live.begin_drag(++step_, "high", {0, 0, 2}); // and dies in mid-drag
        live.drag_to(turned(2));
    }
    const std::vector<LostWork> lost = find_lost_work(state);
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].steps, 3U); // two handles, the drag with its settling
    EXPECT_EQ(lost[0].cloud, folder_ / "bar.ply");

    OpenRequest restore = request_for({});
    restore.journal_folder = state;
    restore.restore = lost[0].journal;
    LiveDocument live(restore);
    wait_until_open(live);
    ASSERT_EQ(live.status().stage, LiveDocument::Stage::open);
    PosedFrame frame;
    ASSERT_TRUE(live.take_frame(frame));
    EXPECT_EQ(frame.positions(), posed.positions());
    EXPECT_FALSE(live.saved().session_state);
    live.post(++step_, {CommitLine{}});
    wait_until_idle(live);
    EXPECT_EQ(read_session(lost[0].journal).lines.size(), 5U) << "the same recording goes on";
}

TEST_F(LiveBar, RestoringSaysSoWhereTheLastLineWasCutShort) {
    const std::string header = R"({"knead":1,"cloud":{"path":"bar.ply"}})"
                               "\n";
    const std::string renamed = R"({"op":"set","iterations":4})"
                                "\n";
    for (const char* torn : {"", R"({"op":"commit"})", R"({"op":"com)"}) {
        write_text(folder_ / "torn.knead", header + renamed + torn);
        OpenRequest restore = request_for({});
        restore.restore = folder_ / "torn.knead";
        LiveDocument live(restore);
        wait_until_open(live);
        ASSERT_EQ(live.status().stage, LiveDocument::Stage::open);
        EXPECT_EQ(live.view()->acts, std::string(torn).ends_with('}') ? 2U : 1U);
        const std::vector<Notice> notices = live.take_notices();
        EXPECT_EQ(notices.size(), std::string(torn) == R"({"op":"com)" ? 1U : 0U);
        for (const Notice& notice : notices)
            EXPECT_NE(notice.words.find("last line"), std::string::npos) << notice.words;
    }
}

TEST_F(LiveBar, AFolderThatCannotBeWrittenLosesTheJournalAndNothingElse) {
    OpenRequest request = request_for(bar_file(folder_));
    request.journal_folder = "/proc/nowhere";
    LiveDocument live(request);
    wait_until_open(live);
    for (const SessionAction& handle : bar_handles()) live.post(++step_, {handle});
    wait_until_idle(live);
    EXPECT_EQ(live.view()->handles.size(), 2U);
    EXPECT_TRUE(live.take_refused().empty());
    EXPECT_EQ(live.take_notices().size(), 1U) << "it is said once";
}

TEST_F(LiveBar, OnlyWhatIsNotSavedIsOfferedForRestoring) {
    live_->save_session(folder_ / "a.knead");
    settle_down();
    const std::filesystem::path state = folder_ / "state";
    OpenRequest request = request_for(folder_ / "a.knead");
    request.journal_folder = state;
    { // only looked at
        LiveDocument live(request);
        wait_until_open(live);
        wait_until_idle(live);
    }
    EXPECT_TRUE(find_lost_work(state).empty());
    { // changed and saved
        LiveDocument live(request);
        wait_until_open(live);
        live.post(++step_, {RenameLine{"high", "top"}});
        live.save_session(folder_ / "b.knead");
        wait_until_idle(live);
    }
    EXPECT_TRUE(find_lost_work(state).empty());
    { // changed, saved, and changed again
        LiveDocument live(request);
        wait_until_open(live);
        live.post(++step_, {RenameLine{"high", "top"}});
        live.save_session(folder_ / "c.knead");
        live.post(++step_, {RenameLine{"low", "bottom"}});
        wait_until_idle(live);
    }
    const std::vector<LostWork> lost = find_lost_work(state);
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(read_session(lost[0].journal).lines.size(), 4U) << "it holds everything from the beginning";
    EXPECT_EQ(lost[0].steps, 1U) << "of which the last is not in the session";
    EXPECT_EQ(lost[0].session, folder_ / "c.knead");
}

TEST_F(LiveBar, GoingBackAndForthAfterASaveIsNoWorkToRestore) {
    live_->save_session(folder_ / "a.knead");
    settle_down();
    const std::filesystem::path state = folder_ / "state";
    OpenRequest request = request_for(folder_ / "a.knead");
    request.journal_folder = state;
    const auto die_after = [&](bool redo) {
        LiveDocument live(request);
        wait_until_open(live);
        live.undo(0);
        if (redo) live.redo(0);
        wait_until_idle(live);
    };
    die_after(true);
    EXPECT_TRUE(find_lost_work(state).empty());
    for (const auto& left : std::filesystem::directory_iterator(state))
        EXPECT_TRUE(left.is_directory()) << left.path();
    die_after(false);
    EXPECT_EQ(find_lost_work(state).size(), 1U) << "something was undone";
}

TEST_F(LiveBar, WhatIsRestoredIsSavedWhereItWasSavedBefore) {
    const std::filesystem::path session = folder_ / "a.knead", state = folder_ / "state";
    OpenRequest request = request_for(bar_file(folder_));
    request.journal_folder = state;
    request.choose_samples = true;
    const auto die = [&](bool theirs) {
        {
            LiveDocument live(request);
            wait_until_open(live);
            for (const SessionAction& handle : bar_handles()) live.post(++step_, {handle});
            live.save_session(session, true);
            live.post(++step_, {RenameLine{"high", "top"}});
            wait_until_idle(live);
        }
        if (theirs) write_text(session, "theirs");
        const std::vector<LostWork> lost = find_lost_work(state);
        ASSERT_EQ(lost.size(), 1U);
        OpenRequest restore = request_for({});
        restore.restore = lost[0].journal;
        LiveDocument live(restore);
        wait_until_open(live);
        EXPECT_TRUE(live.view()->chooses_samples);
        EXPECT_EQ(live.view()->session, session);
        EXPECT_TRUE(live.saved().session_state);
        EXPECT_NE(live.saved().session_state, live.view()->state);
        live.save_session(session);
        wait_until_idle(live);
        EXPECT_EQ(live.take_held_saves().size(), theirs ? 1U : 0U);
        if (!theirs) {
            EXPECT_EQ(live.saved().session_state, live.view()->state);
            // A slow machine's choice of samples may come after it.
            const std::vector<std::string> lines = lines_in(session);
            EXPECT_EQ(std::ranges::count(lines, to_text(RenameLine{"high", "top"})), 1);
        }
        live.discard_journal();
    };
    die(false);
    die(true);
    EXPECT_EQ(read_text(session), "theirs");
}

TEST_F(LiveBar, ASavedSessionKnowsItsCloudAgain) {
    const std::filesystem::path session = folder_ / "a.knead", elsewhere = folder_ / "elsewhere.ply";
    live_->save_session(session);
    settle_down();
    EXPECT_EQ(read_session(session).sha256, sha256_of_file(folder_ / "bar.ply"));

    // Another cloud of as many points comes to lie there.
    std::filesystem::rename(folder_ / "bar.ply", elsewhere);
    HandlePose pose;
    pose.translate = {0, 0, 0.1};
    live_->post(++step_, {DragLine{"high", {0, 0, 2}, {pose}}});
    live_->save_cloud(folder_ / "bar.ply");
    live_->take_notices();
    live_->save_session(session);
    settle_down();
    const std::vector<Notice> notices = live_->take_notices();
    EXPECT_TRUE(std::ranges::any_of(notices, [](const Notice& notice) {
        return notice.words.find("is not the file any more") != std::string::npos;
    }));
    EXPECT_EQ(read_session(session).sha256, sha256_of_file(elsewhere)) << "as it was when it was opened";

    OpenRequest request = request_for(session);
    {
        LiveDocument live(request);
        wait_until_open(live);
        EXPECT_EQ(live.status().stage, LiveDocument::Stage::failed);
        EXPECT_TRUE(live.status().wants_cloud);
    }
    request.cloud = elsewhere;
    LiveDocument live(request);
    wait_until_open(live);
    ASSERT_EQ(live.status().stage, LiveDocument::Stage::open);
    EXPECT_EQ(live.opened().file, elsewhere);
    EXPECT_FALSE(live.saved().session_state) << "the session names another cloud";
    live.save_session(folder_ / "b.knead");
    wait_until_idle(live);
    EXPECT_EQ(live.saved().session_state, live.view()->state);
    EXPECT_EQ(read_session(folder_ / "b.knead").cloud, "elsewhere.ply");
}

TEST_F(LiveBar, ASavedSessionNamesItsChecksFromWhereItLies) {
    std::filesystem::create_directory(folder_ / "from");
    std::filesystem::create_directory(folder_ / "to");
    std::filesystem::copy_file(folder_ / "bar.ply", folder_ / "from/check.ply");
    write_text(folder_ / "from/a.knead", R"({"knead":1,"cloud":{"path":"../bar.ply"}})"
                                         "\n"
                                         R"({"op":"check","positions":"check.ply","tolerance":0})"
                                         "\n");
    LiveDocument live(request_for(folder_ / "from/a.knead"));
    wait_until_open(live);
    live.save_session(folder_ / "to/b.knead");
    wait_until_idle(live);
    const Session saved = read_session(folder_ / "to/b.knead");
    ASSERT_EQ(saved.lines.size(), 1U);
    EXPECT_EQ(std::get<CheckLine>(saved.lines[0].action).positions, "../from/check.ply");
}

TEST_F(LiveBar, ACloudThatWasOnlyTouchedOrCopiedBackIsTheSameOne) {
    const std::filesystem::path cloud = folder_ / "bar.ply", session = folder_ / "a.knead";
    const std::string digest = sha256_of_file(cloud);
    const auto saved = [&] { // warnings of it
        live_->take_notices();
        live_->save_session(session);
        settle_down();
        const std::vector<Notice> notices = live_->take_notices();
        EXPECT_EQ(read_session(session).sha256, digest);
        return std::ranges::count(notices, Notice::Kind::warning, &Notice::kind);
    };
    std::this_thread::sleep_for(std::chrono::seconds(1)); // the digest of so few points is made by then
    std::filesystem::last_write_time(cloud, std::filesystem::last_write_time(cloud) + std::chrono::hours(1));
    EXPECT_EQ(saved(), 0);
    std::filesystem::copy_file(cloud, folder_ / "copy.ply");
    std::filesystem::remove(cloud);
    EXPECT_EQ(saved(), 1) << "it is not there";
    std::filesystem::rename(folder_ / "copy.ply", cloud);
    EXPECT_EQ(saved(), 0);
    write_text(cloud, read_text(cloud) + "more");
    EXPECT_EQ(saved(), 1);
}

// Otherwise what was done would be done to what it had made already.
TEST_F(LiveBar, WorkIsNotRestoredOnACloudThatWasWrittenToSince) {
    const std::filesystem::path state = folder_ / "state", copy = folder_ / "copy.ply";
    std::filesystem::copy_file(folder_ / "bar.ply", copy);
    OpenRequest request = request_for(folder_ / "bar.ply");
    request.journal_folder = state;
    {
        LiveDocument live(request);
        wait_until_open(live);
        for (const SessionAction& handle : bar_handles()) live.post(++step_, {handle});
        live.save_cloud(folder_ / "bar.ply");
        wait_until_idle(live);
    }
    OpenRequest restore = request_for({});
    restore.restore = find_lost_work(state).at(0).journal;
    {
        LiveDocument live(restore);
        wait_until_open(live);
        EXPECT_EQ(live.status().stage, LiveDocument::Stage::failed);
        EXPECT_TRUE(live.status().wants_cloud);
    }
    restore.cloud = copy;
    {
        LiveDocument live(restore);
        wait_until_open(live);
        ASSERT_EQ(live.status().stage, LiveDocument::Stage::open);
        EXPECT_EQ(live.view()->handles.size(), 2U);
    }
    // And if that was cut off, too, it is known which cloud it was on.
    const std::vector<LostWork> lost = find_lost_work(state);
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].cloud, copy);
    EXPECT_EQ(lost[0].steps, 2U);
    restore.restore = lost[0].journal;
    restore.cloud.reset();
    LiveDocument again(restore);
    wait_until_open(again);
    EXPECT_EQ(again.status().stage, LiveDocument::Stage::open);
    EXPECT_EQ(again.view()->handles.size(), 2U);
}

TEST_F(LiveBar, FindsItsCloudThroughFoldersThatAreLinks) {
    const std::filesystem::path real = folder_ / "disk" / "deep" / "work", link = folder_ / "work";
    std::filesystem::create_directories(real);
    std::filesystem::create_directory_symlink(real, link);
    live_->save_session(link / "a.knead"); // "../bar.ply" from there is disk/deep/bar.ply
    settle_down();
    for (const std::filesystem::path& session : {link / "a.knead", real / "a.knead"}) {
        LiveDocument live(request_for(session));
        wait_until_open(live);
        ASSERT_EQ(live.status().stage, LiveDocument::Stage::open) << session;
        EXPECT_TRUE(std::filesystem::equivalent(live.opened().file, folder_ / "bar.ply"));
    }
    live_->save_session(folder_ / "b.knead");
    settle_down();
    EXPECT_EQ(read_session(folder_ / "b.knead").cloud, "bar.ply");
}

TEST_F(LiveBar, SettingsThatASessionIsOpenedWithAreAStep) {
    live_->save_session(folder_ / "a.knead");
    settle_down();
    OpenRequest request = request_for(folder_ / "a.knead");
    request.settings.samples = 77U;
    {
        LiveDocument live(request); // settings of another cloud
        wait_until_open(live);
        EXPECT_NE(live.view()->settings.samples, 77U);
    }
    request.sets_session = true;
    LiveDocument live(request);
    wait_until_open(live);
    EXPECT_EQ(live.view()->settings.samples, 77U);
    EXPECT_EQ(live.view()->undoable_steps, 3U);
    EXPECT_NE(live.view()->state, live.saved().session_state);
    live.undo(0);
    wait_until_idle(live);
    EXPECT_NE(live.view()->settings.samples, 77U);
    EXPECT_EQ(live.view()->state, live.saved().session_state);
}

TEST_F(LiveBar, TellsThatItSavesUntilItHas) {
    live_->save_cloud(folder_ / "out.ply");
    EXPECT_TRUE(live_->status().saving);
    ASSERT_TRUE(wait_until([&] { return !live_->status().saving; }));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out.ply"));
    EXPECT_FALSE(live_->take_notices().empty());
    live_->save_cloud("/proc/nowhere/out.ply");
    ASSERT_TRUE(wait_until([&] { return !live_->status().saving; })) << "nor when it could not";
}

TEST_F(LiveBar, OnlyASessionTakesAnotherCloud) {
    OpenRequest request = request_for(bar_file(folder_));
    request.cloud = request.file;
    LiveDocument live(request);
    wait_until_open(live);
    EXPECT_EQ(live.status().stage, LiveDocument::Stage::failed);
    EXPECT_FALSE(live.status().wants_cloud);
}

TEST_F(LiveBar, LookingAtEarlierStepsIsNoWorkToRestore) {
    live_->save_session(folder_ / "a.knead");
    settle_down();
    const std::vector<std::string> handles = lines_in(folder_ / "a.knead");
    ASSERT_EQ(handles.size(), 2U);
    const std::filesystem::path state = folder_ / "state";
    OpenRequest request = request_for(folder_ / "a.knead");
    request.journal_folder = state;
    const auto look_back = [&](LiveDocument& live) {
        wait_until_open(live);
        for (int i = 0; i < 2; ++i) live.undo(0, true);
        live.play(0);
        wait_until_idle(live);
        ASSERT_EQ(live.view()->handles.size(), 1U);
    };
    { // dies in the middle of it
        LiveDocument live(request);
        look_back(live);
    }
    EXPECT_TRUE(find_lost_work(state).empty());
    { // saved there
        LiveDocument live(request);
        look_back(live);
        EXPECT_EQ(live.view()->state, live.saved().session_state);
        live.save_session(folder_ / "b.knead");
        wait_until_idle(live);
        EXPECT_EQ(live.view()->handles.size(), 1U) << "and it is looked at still";
        EXPECT_EQ(live.view()->state, live.saved().session_state);
    }
    const std::string undo = to_text(UndoLine{});
    EXPECT_EQ(lines_in(folder_ / "b.knead"), handles) << "whatever was looked at";
    { // goes on from there
        LiveDocument live(request);
        look_back(live);
        live.post(++step_, {RenameLine{"low", "bottom"}});
        wait_until_idle(live);
    }
    const std::vector<LostWork> lost = find_lost_work(state);
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lines_in(lost[0].journal),
              (std::vector{handles[0], handles[1], undo, to_text(RenameLine{"low", "bottom"})}));
}

TEST_F(LiveBar, WhatWasUndoneStaysSoWhoeverLooksAtIt) {
    live_->undo(0);
    live_->undo(0);
    live_->save_session(folder_ / "a.knead");
    settle_down();
    for (const bool plays : {false, true}) {
        for (int i = 0; i < 2; ++i) plays ? live_->play(0) : live_->redo(0, true);
        settle_down();
        EXPECT_EQ(live_->view()->handles.size(), 2U);
        for (int i = 0; i < 2; ++i) live_->undo(0, true);
        settle_down();
        EXPECT_EQ(live_->view()->state, live_->saved().session_state);
    }
    live_->save_session(folder_ / "b.knead");
    settle_down();
    LiveDocument live(request_for(folder_ / "b.knead"));
    wait_until_open(live);
    EXPECT_TRUE(live.view()->handles.empty());
    EXPECT_EQ(live.view()->redoable_steps, 2U);
}

// A hand that saves right after it let go has the shape at rest all the same.
TEST_F(LiveBar, SavingDoesNotKeepAShapeFromComingToRest) {
    const auto settled = [&](const std::filesystem::path& session) {
        return std::ranges::count_if(lines_in(session), [](const std::string& line) {
            return line.find("settle") != std::string::npos;
        });
    };
    const auto drag_and = [&](auto&& act) {
        live_->begin_drag(++step_, "high", {0, 0, 2});
        live_->drag_to(turned(1));
        live_->end_drag();
        act();
        settle_down();
    };
    drag_and([&] { live_->save_session(folder_ / "a.knead"); });
    EXPECT_EQ(settled(folder_ / "a.knead"), 1);
    EXPECT_EQ(live_->saved().session_state, live_->view()->state) << "and it is not unsaved again at once";
    drag_and([&] { live_->save_cloud(folder_ / "a.ply"); });
    live_->save_session(folder_ / "b.knead");
    settle_down();
    EXPECT_EQ(settled(folder_ / "b.knead"), 2);
}

} // namespace knead::test

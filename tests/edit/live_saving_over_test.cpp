// Saves over files that are there already: those that somebody else changed, and the cloud that was opened.

#include "edit/live_document.h"

#include "edit/live_bar.h"
#include "io/digest.h"

#include <algorithm>

namespace knead::test {

// Somebody else's work is not overwritten unnoticed, under whatever name.
class SavingOver : public LiveBar {
protected:
    // Whether the save that was just posted was held back.
    bool held() {
        settle_down();
        const auto saves = live_->take_held_saves();
        if (!saves.empty()) last_held_ = saves.back();
        return !saves.empty();
    }

    HeldSave last_held_;
};

TEST_F(SavingOver, ASessionThatSomebodyElseChangedIsAskedAbout) {
    const std::filesystem::path session = folder_ / "a.knead";
    live_->save_session(session);
    EXPECT_FALSE(held());
    live_->post(++step_, {RenameLine{"high", "top"}});
    live_->save_session(session);
    EXPECT_FALSE(held()) << "its own writing counts for nothing";
    const std::string own = read_text(session);
    const auto saved_state = live_->saved().session_state;

    write_text(session, "theirs");
    live_->post(++step_, {RenameLine{"low", "bottom"}});
    live_->save_session(session);
    EXPECT_TRUE(held());
    EXPECT_EQ(last_held_.target, session);
    EXPECT_FALSE(last_held_.options);
    EXPECT_EQ(read_text(session), "theirs");
    EXPECT_EQ(live_->saved().session_state, saved_state) << "it is still unsaved";
    live_->save_session(folder_ / "b.knead");
    EXPECT_FALSE(held());
    live_->save_session(session, true);
    EXPECT_FALSE(held());
    EXPECT_EQ(read_text(session), read_text(folder_ / "b.knead"));
    live_->save_session(session);
    EXPECT_FALSE(held()) << "the question was answered";
    std::filesystem::remove(session);
    live_->save_session(session);
    EXPECT_FALSE(held()) << "there is nothing to lose";
    EXPECT_TRUE(std::filesystem::exists(session));
}

TEST_F(SavingOver, AFileThatALinkOnTheWayNowLeadsToIsAskedAbout) {
    for (const char* version : {"v1", "v2"}) std::filesystem::create_directory(folder_ / version);
    std::filesystem::create_directory_symlink("v1", folder_ / "current");
    live_->save_session(folder_ / "current/a.knead");
    EXPECT_FALSE(held());
    write_text(folder_ / "v2/a.knead", "theirs");
    std::filesystem::remove(folder_ / "current");
    std::filesystem::create_directory_symlink("v2", folder_ / "current");
    live_->save_session(folder_ / "current/a.knead");
    EXPECT_TRUE(held());
    EXPECT_EQ(read_text(folder_ / "v2/a.knead"), "theirs");
}

TEST_F(SavingOver, EverySaveThatIsHeldBackIsAskedAbout) {
    for (const char* name : {"a.knead", "b.knead"}) {
        live_->save_session(folder_ / name);
        settle_down();
        write_text(folder_ / name, "theirs");
    }
    for (const char* name : {"a.knead", "b.knead"}) live_->save_session(folder_ / name);
    settle_down();
    const auto saves = live_->take_held_saves();
    ASSERT_EQ(saves.size(), 2U);
    EXPECT_EQ(saves[0].target, folder_ / "a.knead");
}

TEST_F(SavingOver, ACloudThatSomebodyElseReplacedIsAskedAbout) {
    const std::filesystem::path cloud = live_->opened().file;
    std::filesystem::create_symlink("bar.ply", folder_ / "link.ply");
    live_->save_cloud(cloud);
    EXPECT_FALSE(held());
    // The same bytes, but another file: whoever wrote it may have meant something by it.
    std::filesystem::copy_file(cloud, folder_ / "theirs");
    std::filesystem::rename(folder_ / "theirs", cloud);
    const auto theirs = stamp_of(cloud);
    for (const std::filesystem::path& name : {cloud, folder_ / "link.ply"}) {
        live_->save_cloud(name, {.stretch = true});
        EXPECT_TRUE(held());
        EXPECT_EQ(last_held_.target, name);
        EXPECT_TRUE(last_held_.options && last_held_.options->stretch);
        EXPECT_EQ(stamp_of(cloud), theirs);
    }
    live_->save_cloud(cloud, {}, true);
    EXPECT_FALSE(held());
    EXPECT_NE(stamp_of(cloud), theirs);
}

// The session that goes on is about the copy, by whatever way it is opened again, and only the first cloud
// that is saved there takes the place of the original.
TEST_F(SavingOver, TheOriginalIsKeptOnWish) {
    const std::filesystem::path cloud = live_->opened().file, copy = folder_ / "bar-original.ply";
    const std::string original = read_text(cloud);
    live_->save_session(folder_ / "a.knead");
    drag({turned(0.1)});
    live_->save_cloud(cloud, {}, false, true);
    EXPECT_FALSE(held());
    EXPECT_EQ(read_text(copy), original);
    EXPECT_NE(read_text(cloud), original);
    EXPECT_EQ(live_->view()->cloud, copy);
    EXPECT_FALSE(live_->saved().session_state) << "what was saved names the other one";
    live_->save_cloud(cloud, {}, false, true);
    EXPECT_FALSE(held());
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bar-original-2.ply"));

    live_->take_notices();
    live_->save_session(folder_ / "a.knead");
    settle_down();
    for (const Notice& notice : live_->take_notices())
        EXPECT_EQ(notice.kind, Notice::Kind::information) << notice.words;
    EXPECT_EQ(read_session(folder_ / "a.knead").cloud, "bar-original.ply");
    EXPECT_EQ(read_session(folder_ / "a.knead").sha256, sha256_of_file(copy));
    LiveDocument again(request_for(folder_ / "a.knead"));
    wait_until_open(again);
    EXPECT_EQ(again.status().stage, LiveDocument::Stage::open);
    EXPECT_EQ(again.opened().file, copy);
}

TEST_F(SavingOver, ACrashLeavesWhatGoesByTheOriginal) {
    OpenRequest request = request_for(live_->opened().file);
    request.journal_folder = folder_ / "state";
    open(request);
    live_->save_session(folder_ / "a.knead");
    drag({turned(0.1)});
    live_->save_cloud(live_->opened().file, {}, false, true);
    drag({turned(0.2)});
    live_.reset();
    const std::vector<LostWork> lost = find_lost_work(folder_ / "state");
    ASSERT_EQ(lost.size(), 1U);
    EXPECT_EQ(lost[0].cloud, folder_ / "bar-original.ply");
    request.file = lost[0].journal;
    request.restore = lost[0].journal;
    live_ = std::make_unique<LiveDocument>(request);
    wait_until_open(*live_);
    ASSERT_EQ(live_->status().stage, LiveDocument::Stage::open);
    EXPECT_EQ(live_->view()->undoable_steps, 4U);
    EXPECT_NE(live_->saved().session_state, live_->view()->state) << "the session names the other cloud";
}

TEST_F(SavingOver, WhereTheOriginalCannotBeKeptNothingIsOverwritten) {
    const std::filesystem::path cloud = live_->opened().file;
    const std::string original = read_text(cloud);
    drag({turned(0.1)});
    write_text(cloud, original); // by somebody else, or so it seems
    live_->take_notices();
    live_->save_cloud(cloud, {}, true, true);
    settle_down();
    const std::vector<Notice> notices = live_->take_notices();
    EXPECT_TRUE(std::ranges::any_of(notices,
                                    [](const Notice& notice) { return notice.kind == Notice::Kind::error; }));
    EXPECT_EQ(read_text(cloud), original);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "bar-original.ply"));
}

TEST_F(SavingOver, AnOpenedSessionIsKnownToo) {
    live_->save_session(folder_ / "a.knead");
    settle_down();
    live_ = std::make_unique<LiveDocument>(request_for(folder_ / "a.knead"));
    wait_until_open(*live_);
    live_->save_session(folder_ / "a.knead");
    EXPECT_FALSE(held());
    write_text(folder_ / "a.knead", read_text(folder_ / "a.knead") + "\n");
    live_->save_session(folder_ / "a.knead");
    EXPECT_TRUE(held());
}

} // namespace knead::test

// Steps that are done again frame by frame, to be looked at.

#include "edit/live_bar.h"
#include "io/cloud_file.h"

#include <cmath>
#include <numbers>

namespace knead::test {

namespace {

constexpr double pi = std::numbers::pi;

class PlayedBar : public LiveBar {
protected:
    // A drag of many frames, undone again; keeps the shape that it made.
    void drag_and_undo() {
        std::vector<Transform> poses;
        for (int k = 1; k <= 12; ++k) poses.push_back(turned(k * pi / 24, {1, 0, 0}));
        drag(poses);
        dragged_ = frame_.positions();
        live_->undo(step_);
        settle_down();
        ASSERT_NE(frame_.positions(), dragged_);
    }

    bool is_held_at(std::size_t frame) {
        return wait_until([&] {
            const LiveDocument::Status status = live_->status();
            live_->take_frame(frame_);
            return status.playing && status.playing->frame == frame && !status.busy;
        });
    }

    // In what is recorded.
    DragLine last_drag() {
        live_->save_session(folder_ / "frames.knead");
        settle_down();
        DragLine last;
        for (const SessionLine& line : read_session(folder_ / "frames.knead").lines)
            if (const auto* drag = std::get_if<DragLine>(&line.action)) last = *drag;
        return last;
    }
    std::size_t recorded_frames() { return last_drag().frames.size(); }

    LineArray<float> dragged_;
};

} // namespace

TEST_F(PlayedBar, ShowsTheFramesAndEndsAtTheVeryShape) {
    drag_and_undo();
    live_->set_play_pace(1, false);
    const std::uint64_t first = frame_.version;
    live_->play(step_);
    std::size_t shown = 0, last = 0;
    ASSERT_TRUE(wait_until([&] {
        const LiveDocument::Status status = live_->status();
        if (status.playing && status.playing->handle == "high" && status.playing->frame > last) {
            last = status.playing->frame;
            ++shown;
        }
        return !status.busy;
    }));
    live_->take_frame(frame_);
    EXPECT_GT(shown, 2U);
    EXPECT_GT(frame_.version, first + 3);
    EXPECT_EQ(frame_.positions(), dragged_);
    EXPECT_FALSE(live_->status().playing);
    EXPECT_TRUE(live_->view()->posed);
    EXPECT_EQ(live_->view()->redoable_steps, 0U);
    expect_replay_makes_the_same();
}

TEST_F(PlayedBar, IsHeldAndGoesBackAndForthByFrames) {
    drag_and_undo();
    const LineArray<float> rest = frame_.positions();
    live_->set_play_pace(1, true);
    live_->play(step_);
    live_->advance_play(1);
    ASSERT_TRUE(is_held_at(1));
    const LineArray<float> one = frame_.positions();
    EXPECT_NE(one, rest);
    live_->advance_play(2);
    ASSERT_TRUE(is_held_at(3));
    EXPECT_NE(frame_.positions(), one);
    live_->advance_play(-2);
    ASSERT_TRUE(is_held_at(1));
    EXPECT_EQ(frame_.positions(), one);
    live_->advance_play(-1);
    ASSERT_TRUE(is_held_at(0));
    EXPECT_EQ(frame_.positions(), rest);
    live_->set_play_pace(4, false);
    settle_down();
    EXPECT_EQ(frame_.positions(), dragged_);
}

TEST_F(PlayedBar, WhatIsSavedInTheMiddleIsWhatIsSeen) {
    drag_and_undo();
    live_->set_play_pace(1, true);
    live_->play(step_);
    live_->advance_play(3);
    ASSERT_TRUE(is_held_at(3));
    const LineArray<float> seen = frame_.positions();
    live_->save_cloud(folder_ / "seen.ply", {.displacement = true});
    ASSERT_TRUE(wait_until([&] { return !live_->status().saving; }));
    SilentProgress silent;
    const PointCloud saved = read_cloud(folder_ / "seen.ply", silent);
    const std::vector<Index>& file_index = live_->opened().order->file_index;
    for (std::size_t i = 0; i < file_index.size(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const double in_file = saved.origin[static_cast<Eigen::Index>(axis)] +
                                   static_cast<double>(saved.positions[3 * file_index[i] + axis]);
            const double on_screen = live_->opened().cloud->origin[static_cast<Eigen::Index>(axis)] +
                                     static_cast<double>(seen[3 * i + axis]);
            ASSERT_NEAR(in_file, on_screen, 1e-5);
        }
    ASSERT_TRUE(is_held_at(3)) << "and it is held there still";
    live_->set_play_pace(4, false);
    settle_down();
    EXPECT_EQ(frame_.positions(), dragged_);
    EXPECT_EQ(live_->view()->last_frames, recorded_frames());
}

TEST_F(PlayedBar, AnActInTheMiddleComesAfterTheWholeStep) {
    drag_and_undo();
    live_->set_play_pace(1, true);
    live_->play(step_);
    live_->advance_play(2);
    ASSERT_TRUE(is_held_at(2));
    live_->undo(step_);
    settle_down();
    EXPECT_FALSE(live_->view()->posed);
    live_->play(step_);
    live_->advance_play(2);
    ASSERT_TRUE(is_held_at(2));
    drag({turned(0.3, {0, 1, 0})});
    EXPECT_EQ(live_->view()->undoable_steps, 4U) << "two handles, the drag that was played, and another";
    live_->undo(step_);
    settle_down();
    EXPECT_EQ(frame_.positions(), dragged_);
    expect_replay_makes_the_same();
}

TEST_F(PlayedBar, WhatDoesNotMoveIsRedoneAtOnce) {
    live_->undo(step_);
    settle_down();
    EXPECT_EQ(live_->view()->handles.size(), 1U);
    live_->set_play_pace(1, false);
    live_->play(step_);
    settle_down();
    EXPECT_EQ(live_->view()->handles.size(), 2U);
    EXPECT_EQ(live_->view()->last_words, "new moving handle \"high\"");
}

// Two whole turns leave the handle where it was; only unwinding them brings the middle back.
TEST_F(PlayedBar, ResettingAPoseUnwindsItsTurns) {
    const LineArray<float> rest = frame_.positions();
    drag({turned(2 * pi)});
    EXPECT_GT(largest_displacement(), 0.2);
    live_->reset_poses(++step_, {"high"});
    settle_down();
    EXPECT_LT(largest_displacement(), 1e-4);
    EXPECT_FALSE(live_->view()->posed) << "there is nothing to commit, nor to reset";
    live_->post(++step_, {RenameLine{"low", "bottom"}});
    settle_down();
    SettingsChange strays;
    strays.strays = Strays::carry;
    live_->post(++step_, {SetLine{strays}});
    settle_down();
    for (const Notice& notice : live_->take_notices())
        EXPECT_EQ(notice.words.find("committed"), std::string::npos) << "which nobody would see";
    live_->undo(step_--);
    live_->undo(step_--);
    live_->undo(step_);
    settle_down();
    EXPECT_GT(largest_displacement(), 0.2);
    live_->redo(step_);
    expect_replay_makes_the_same();
}

// A handle that was turned in place turns back in place, wherever a commit left it.
TEST_F(PlayedBar, ResettingAPoseGoesByTheMiddleInTheShapeThatWasCommitted) {
    Transform shift;
    shift.shift = {3, 0, 0};
    drag({shift});
    live_->post(++step_, {CommitLine{}});
    settle_down();
    Transform turn;
    turn.pivot = {3, 0, 2.25};
    turn.axis = {0, 0, 1};
    turn.angle = 2.6;
    drag({turn});
    live_->reset_poses(++step_, {"high"});
    settle_down();
    const DragLine back = last_drag();
    EXPECT_NEAR(back.pivot.x(), 3, 0.02);
    for (const HandlePose& pose : back.frames) EXPECT_LT(pose.translate.norm(), 0.02);
}

} // namespace knead::test

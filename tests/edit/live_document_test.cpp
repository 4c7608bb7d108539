#include "edit/live_document.h"

#include "edit/live_bar.h"

#include <cmath>
#include <future>
#include <numbers>

namespace knead::test {

namespace {

constexpr double pi = std::numbers::pi;

} // namespace

TEST_F(LiveBar, OpensWithItsPointsInTheOrderOfComputation) {
    const OpenedCloud opened = live_->opened();
    EXPECT_EQ(opened.cloud->size(), 3000U);
    EXPECT_TRUE(std::ranges::equal(frame_.positions(), opened.opened->positions));
    EXPECT_EQ(opened.order->points(), 3000U);
    EXPECT_GT(opened.spacing, 0.02);
    EXPECT_LT(opened.spacing, 0.2);
    EXPECT_TRUE(live_->view()->graph) << "stages are prepared before they are needed";
}

TEST_F(LiveBar, FollowsTheHandAndItsRecordingReplaysToTheSameBytes) {
    std::vector<Transform> poses;
    for (int k = 1; k <= 30; ++k) poses.push_back(turned(k * pi / 45, {1, 0, 0}));
    drag(poses);
    EXPECT_TRUE(live_->view()->posed);
    EXPECT_GT(largest_displacement(), 0.3);
    expect_replay_makes_the_same();
}

TEST_F(LiveBar, SeveralEditsReplayToTheSameBytes) {
    drag({turned(0.5), turned(1.0)});
    Transform lift;
    lift.shift = {0.5, 0, 0.3};
    lift.scale = {1.2, 1.0, 0.9};
    drag({lift});
    SettingsChange softer;
    softer.stiffness = 0.05;
    live_->post(++step_, {SetLine{softer}});
    settle_down();
    live_->post(++step_, {CommitLine{}});
    drag({turned(0.7, {0, 1, 0})});
    live_->undo(step_);
    live_->undo(step_);
    live_->redo(step_);
    drag({turned(-0.4, {0, 1, 0})});
    expect_replay_makes_the_same();
}

TEST_F(LiveBar, WhereAllSamplesAreTooSlowFewFollowTheHandAndAllComeToRest) {
    const std::vector<Transform> way{turned(0.2), turned(0.4), turned(0.6), turned(0.8)};
    SettingsChange all;
    all.samples = std::optional<std::uint64_t>{};
    std::vector<LineArray<float>> rested;
    for (const double quick : {0.0, 1e9}) {
        OpenRequest request = request_for(bar_file(folder_));
        request.settings = all;
        request.quick = quick;
        open(std::move(request));
        ASSERT_FALSE(HasFailure());
        drag(way);
        live_->begin_drag(++step_, "high", {0, 0, 2});
        live_->drag_to(turned(0.3, {1, 0, 0}));
        wait_until_idle(*live_); // the hand rests in the middle of the drag
        live_->drag_to(turned(0.6, {1, 0, 0}));
        live_->end_drag();
        settle_down();
        rested.push_back(frame_.positions());
        expect_replay_makes_the_same();
        std::size_t coarse = 0, others = 0;
        for (const SessionLine& line : read_session(folder_ / "saved.knead").lines)
            if (const auto* drag = std::get_if<DragLine>(&line.action))
                for (const HandlePose& pose : drag->frames) ++(pose.coarse ? coarse : others);
        EXPECT_EQ(coarse > 0, quick == 0);
        EXPECT_GT(others, 0U) << "frames of all samples while the hand rests";
    }
    double farthest = 0;
    for (std::size_t i = 0; i < rested[0].size(); ++i)
        farthest = std::max(farthest, std::abs(static_cast<double>(rested[0][i] - rested[1][i])));
    EXPECT_LT(farthest, 1e-3); // of a bar 5 long: what settling leaves
}

TEST_F(LiveBar, ATypedTwoTurnsKeepsThemAll) {
    drag({turned(4 * pi)});
    // The handle is back where it was, and the middle has made one turn on the way: points there are at rest
    // in position, so the recording must tell: it winds up in small steps.
    live_->save_session(folder_ / "wound.knead");
    settle_down();
    const Session session = read_session(folder_ / "wound.knead");
    const auto* line = std::get_if<DragLine>(&session.lines.at(2).action);
    ASSERT_NE(line, nullptr);
    EXPECT_GE(line->frames.size(), 36U);
    Quatd before = Quatd::Identity();
    double turned_so_far = 0;
    for (const HandlePose& pose : line->frames) {
        Quatd now = pose.rotate;
        if (now.dot(before) < 0) now.coeffs() = -now.coeffs();
        const Eigen::AngleAxisd step(now * before.conjugate());
        turned_so_far += step.angle() * (step.axis().z() < 0 ? -1 : 1);
        before = now;
    }
    EXPECT_NEAR(turned_so_far, 4 * pi, 1e-6);
    EXPECT_NEAR(live_->view()->motions.at(1).rotation.w(), 1, 1e-9);
}

TEST_F(LiveBar, ACancelledDragNeverWas) {
    drag({turned(0.5)});
    const PosedFrame before = frame_;
    const std::size_t acts = live_->view()->acts;
    live_->begin_drag(++step_, "high", {0, 0, 2});
    live_->drag_to(turned(2));
    ASSERT_TRUE(wait_until([&] { return live_->take_frame(frame_) && frame_.shows_pose; }));
    live_->cancel_drag();
    settle_down();
    EXPECT_EQ(frame_.positions(), before.positions());
    EXPECT_EQ(live_->view()->acts, acts);
    EXPECT_EQ(live_->take_refused(), std::vector<LiveDocument::Refused>{{step_}});
    EXPECT_TRUE(live_->take_notices().empty());
}

TEST_F(LiveBar, UndoAndRedoAreExactAndOneStepADrag) {
    const LineArray<float> rest = frame_.positions();
    drag({turned(0.5)});
    const LineArray<float> first = frame_.positions();
    drag({turned(0.9, {1, 0, 0})});
    const LineArray<float> second = frame_.positions();
    EXPECT_EQ(live_->view()->undoable_steps, 4U);
    live_->undo(step_);
    settle_down();
    EXPECT_EQ(frame_.positions(), first);
    live_->undo(step_);
    settle_down();
    EXPECT_EQ(frame_.positions(), rest);
    EXPECT_FALSE(live_->view()->posed);
    live_->redo(step_);
    live_->redo(step_);
    settle_down();
    EXPECT_EQ(frame_.positions(), second);
    EXPECT_EQ(live_->view()->redoable_steps, 0U);
}

TEST_F(LiveBar, CommitsBeforeALineThatNeedsIt) {
    drag({turned(0.5)});
    HandleLine middle{"middle", HandleRole::fixed, Region(BoxRegion{{-1, -1, -0.2}, {1, 1, 0.2}})};
    live_->post(++step_, {middle});
    settle_down();
    EXPECT_FALSE(live_->view()->posed);
    EXPECT_EQ(live_->view()->handles.size(), 3U);
    live_->undo(step_); // the handle and its commit are one step
    settle_down();
    EXPECT_TRUE(live_->view()->posed);
    EXPECT_EQ(live_->view()->handles.size(), 2U);
}

TEST_F(LiveBar, ARefusedStepLeavesNoTraceAndSaysWhy) {
    const std::size_t steps = live_->view()->undoable_steps;
    live_->post(++step_, {RenameLine{"high", "top"}, DeleteLine{"nobody"}});
    settle_down();
    EXPECT_EQ(live_->view()->undoable_steps, steps);
    EXPECT_EQ(live_->view()->handles.at(1).name, "high");
    const std::vector<LiveDocument::Refused> refused{{step_, true}}; // what was renamed meanwhile ended redo
    EXPECT_EQ(live_->take_refused(), refused);
    const std::vector<Notice> notices = live_->take_notices();
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_EQ(notices[0].kind, Notice::Kind::error);
    EXPECT_NE(notices[0].words.find("nobody"), std::string::npos);
}

TEST_F(LiveBar, GoesOnFromASavedSession) {
    drag({turned(0.5), turned(1.0, {1, 0, 0})});
    const LineArray<float> posed = frame_.positions();
    live_->save_session(folder_ / "saved.knead");
    settle_down();
    LiveDocument again(request_for(folder_ / "saved.knead"));
    wait_until_open(again);
    ASSERT_EQ(again.status().stage, LiveDocument::Stage::open);
    PosedFrame frame;
    ASSERT_TRUE(again.take_frame(frame));
    EXPECT_EQ(frame.positions(), posed);
    EXPECT_EQ(again.view()->undoable_steps, 3U);
    EXPECT_EQ(again.saved().session_state, again.view()->state) << "there is nothing to save yet";
}

TEST_F(LiveBar, AnActPostedDuringADragComesAfterIt) {
    live_->begin_drag(++step_, "high", {0, 0, 2});
    live_->drag_to(turned(0.5));
    ASSERT_TRUE(wait_until([&] { return live_->take_frame(frame_) && frame_.shows_pose; }));
    live_->post(++step_, {RenameLine{"high", "top"}});
    live_->save_cloud(folder_ / "between.ply");
    live_->drag_to(turned(1, {1, 0, 0}));
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    EXPECT_EQ(live_->view()->handles.at(1).name, "high");
    live_->end_drag();
    settle_down();
    EXPECT_EQ(live_->view()->handles.at(1).name, "top");
    EXPECT_TRUE(std::filesystem::exists(folder_ / "between.ply"));
    EXPECT_TRUE(live_->take_refused().empty());
    expect_replay_makes_the_same();
}

TEST_F(LiveBar, AnAbsurdPoseIsRefusedAndTheDragGoesOn) {
    Transform far;
    far.shift = {1e30, 0, 0};
    live_->begin_drag(++step_, "high", {0, 0, 2});
    live_->drag_to(turned(0.5));
    ASSERT_TRUE(wait_until([&] { return live_->take_frame(frame_) && frame_.shows_pose; }));
    live_->drag_to(far);
    live_->end_drag();
    settle_down();
    EXPECT_EQ(live_->take_notices().size(), 1U);
    drag({turned(0.8)});
    EXPECT_EQ(live_->view()->undoable_steps, 4U);
    expect_replay_makes_the_same();
}

TEST_F(LiveBar, SaysWhatHandlesAskForAsLongAsTheyDo) {
    const auto said = [&] { // about what handles ask for, from oldest to newest
        std::vector<std::string> words;
        for (const Notice& notice : live_->take_notices())
            if (notice.about == Notice::About::demand) words.push_back(notice.words);
        return words;
    };
    Transform lift;
    lift.shift = {0, 0, 12};
    drag({lift});
    const std::vector<std::string> once = said();
    ASSERT_EQ(once.size(), 1U);
    EXPECT_NE(once[0].find("pull the cloud"), std::string::npos) << once[0];
    drag({lift}); // as far again
    const std::vector<std::string> twice = said();
    ASSERT_EQ(twice.size(), 1U);
    EXPECT_NE(twice[0], once[0]);
    live_->undo(step_);
    settle_down();
    EXPECT_EQ(said(), std::vector<std::string>{""});
    drag({lift});
    EXPECT_EQ(said(), twice) << "again, after it was undone";
    lift.shift = {0, 0, -24};
    drag({lift});
    EXPECT_EQ(said(), std::vector<std::string>{""});
}

TEST_F(LiveBar, SavesDisplacementAndStretchOnWish) {
    Transform lift;
    lift.shift = {0, 0, 1};
    drag({lift});
    live_->save_cloud(folder_ / "more.ply", {true, true});
    settle_down();
    SilentProgress silent;
    const PointCloud saved = read_cloud(folder_ / "more.ply", silent);
    const auto far = find_attribute(saved, "displacement");
    const auto stretch = find_attribute(saved, "stretch");
    ASSERT_TRUE(far && stretch);
    double mean = 0;
    for (std::size_t i = 0; i < saved.size(); ++i) {
        const Vec3d went = saved.file_position(i) - live_->opened().cloud->file_position(i);
        EXPECT_NEAR(value_at(saved.attributes[*far], i), went.norm(), 1e-5);
        mean += value_at(saved.attributes[*stretch], i) / static_cast<double>(saved.size());
    }
    EXPECT_GT(mean, 1.05);
    EXPECT_LT(mean, 1.3);
}

TEST_F(LiveBar, LeavesHiddenPointsOutOnWish) {
    const OpenedCloud opened = live_->opened();
    std::vector<std::uint8_t> hidden(opened.order->file_index.size());
    std::vector<Vec3d> stay; // in the order of the file
    for (std::size_t i = 0; i < hidden.size(); ++i)
        hidden[i] = opened.cloud->position(opened.order->file_index[i]).z() > 0 ? 1 : 0;
    for (std::size_t i = 0; i < opened.cloud->size(); ++i)
        if (!(opened.cloud->position(i).z() > 0)) stay.push_back(opened.cloud->file_position(i));
    live_->save_cloud(folder_ / "all.ply", {}, false, false, hidden); // hidden, but nobody wishes it
    live_->save_cloud(folder_ / "part.ply", {.displacement = true, .without_hidden = true}, false, false,
                      hidden);
    settle_down();
    SilentProgress silent;
    EXPECT_EQ(read_cloud(folder_ / "all.ply", silent).size(), opened.cloud->size());
    const PointCloud part = read_cloud(folder_ / "part.ply", silent);
    ASSERT_EQ(part.size(), stay.size());
    for (std::size_t i = 0; i < stay.size(); ++i) ASSERT_EQ(part.file_position(i), stay[i]) << i;
    EXPECT_TRUE(find_attribute(part, "displacement"));
    bool told = false;
    for (const Notice& notice : live_->take_notices())
        told |= notice.words.find("without its") != std::string::npos;
    EXPECT_TRUE(told);
    live_->save_cloud(folder_ / "none.ply", {.without_hidden = true}, false, false,
                      std::vector<std::uint8_t>(hidden.size(), 1));
    settle_down();
    EXPECT_FALSE(std::filesystem::exists(folder_ / "none.ply"));
}

TEST(LiveDocument, SaysWhyAFileCannotBeOpened) {
    LiveDocument live(request_for("/nowhere/at/all.ply"));
    wait_until_open(live);
    EXPECT_EQ(live.status().stage, LiveDocument::Stage::failed);
    const std::vector<Notice> notices = live.take_notices();
    ASSERT_EQ(notices.size(), 1U);
    EXPECT_NE(notices[0].words.find("/nowhere/at/all.ply"), std::string::npos);
}

TEST(LiveDocument, SaysNothingOfAnOpeningThatWasCancelled) {
    const ScratchFolder folder;
    std::promise<void> cancelled; // opening does not go on before it is
    OpenRequest request = request_for(bar_file(folder));
    request.make_upsampler = [&](const std::string& device, Workers& workers, unsigned threads) {
        cancelled.get_future().wait();
        return make_upsampler(device, workers, threads);
    };
    LiveDocument live(std::move(request));
    live.cancel_opening();
    cancelled.set_value();
    wait_until_open(live);
    EXPECT_EQ(live.status().stage, LiveDocument::Stage::failed);
    EXPECT_TRUE(live.take_notices().empty()) << "the user knows";
}

// One that says it shares memory with OpenGL: a GPU in a window.
class SharingUpsampler final : public Upsampler {
public:
    explicit SharingUpsampler(std::unique_ptr<Upsampler> inner) : inner_(std::move(inner)) {}
    std::string device() const override { return inner_->device(); }
    void prepare(const UpsampleInput& input, std::size_t motions) override {
        inner_->prepare(input, motions);
    }
    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held held) override {
        return inner_->run(motions, positions, normals, held);
    }
    std::shared_ptr<const DeviceFrame> frame(std::span<const Motion> motions) override {
        return inner_->frame(motions);
    }
    bool shares_with_opengl() const override { return true; }
    std::size_t influence_bytes() const override { return inner_->influence_bytes(); }

private:
    std::unique_ptr<Upsampler> inner_;
};

// As in the window of a computer whose device draws: frames of a drag come without points.
TEST_F(LiveBar, WhereTheDeviceDrawsTheDragThePointsComeWhenTheHandRests) {
    if (list_devices().empty()) GTEST_SKIP() << "there is no OpenCL device";
    OpenRequest request = request_for(bar_file(folder_));
    request.device = "0";
    request.make_upsampler = [](const std::string&, Workers& workers, unsigned threads) {
        auto inner = make_opencl_upsampler(0, workers, threads, {.memory = DeviceMemory::own});
        return UpsamplerChoice{std::make_unique<SharingUpsampler>(std::move(inner)), {}};
    };
    open(std::move(request));
    ASSERT_FALSE(HasFailure());
    live_->draw_drags_on_device(true);
    const LineArray<float> rest = frame_.positions();

    live_->begin_drag(++step_, "high", {0, 0, 2});
    live_->drag_to(turned(3, {1, 0, 0})); // takes several frames
    ASSERT_TRUE(wait_until([&] { return live_->take_frame(frame_) && frame_.on_device; }));
    EXPECT_TRUE(frame_.shows_pose);
    EXPECT_GT(frame_.version, frame_.points_version);
    EXPECT_EQ(frame_.positions(), rest);

    settle_down(); // the hand rests
    EXPECT_FALSE(frame_.on_device);
    EXPECT_EQ(frame_.version, frame_.points_version);
    EXPECT_GT(largest_displacement(), 0.3);
    const LineArray<float> resting = frame_.positions();
    std::vector<PointRange> changed;
    changed_since(frame_.version - 1, frame_, changed);
    ASSERT_EQ(changed.size(), 1U);
    EXPECT_EQ(changed[0].first, 0U);
    EXPECT_EQ(changed[0].end, rest.size() / 3) << "whoever drew other points needs all of these";

    live_->drag_to(turned(3.2, {1, 0, 0}));
    live_->end_drag(); // before it rests
    settle_down();
    EXPECT_FALSE(frame_.on_device);
    EXPECT_NE(frame_.positions(), resting);
    const LineArray<float> posed = frame_.positions();

    live_->begin_drag(++step_, "high", {0, 0, 2});
    live_->drag_to(turned(-2, {1, 0, 0}));
    ASSERT_TRUE(wait_until([&] { return live_->take_frame(frame_) && frame_.on_device; }));
    live_->draw_drags_on_device(false); // the colours follow the pose now, say
    live_->drag_to(turned(-2.1, {1, 0, 0}));
    ASSERT_TRUE(wait_until([&] { return live_->take_frame(frame_) && !frame_.on_device; }));
    live_->cancel_drag();
    settle_down();
    EXPECT_EQ(frame_.positions(), posed);
}

// What could be prepared meanwhile waits for the drag's end, and is no reason to be busy until then.
TEST_F(LiveBar, AHandThatRestsInADragIsNoWork) {
    SetLine fewer;
    fewer.change.samples = std::optional<std::uint64_t>(300);
    live_->post(++step_, {fewer});
    live_->begin_drag(++step_, "high", {0, 0, 2}); // at once
    live_->drag_to(turned(0.3));
    wait_until_idle(*live_);
    live_->end_drag();
    settle_down();
    EXPECT_GT(largest_displacement(), 0.1);
}

} // namespace knead::test

// A device that fails in the middle of an edit: another one takes over, the pose is right, and the user hears
// of it.

#include "edit/editing.h"
#include "edit/live_bar.h"
#include "io/cloud_file.h"
#include "upsample/failing_upsampler.h"

namespace knead::test {
namespace {

// Two edits, with undo, so that shapes are made again and the device is prepared several times.
const std::string wriggle = ends + drag(turn('y', 20) + "," + turn('y', 40)) + settle(5) + commit +
                            drag(turn('z', 30) + "," + turn('z', 60)) + undo + redo + undo + undo +
                            drag(turn('x', 10));

struct Replayed {
    ReplayReport report;
    std::string bytes;
};

Replayed replayed(const ScratchFolder& folder, const UpsamplerMaker& maker) {
    ReplayOptions options;
    options.out = folder / "out.ply";
    options.threads = 2;
    options.make_upsampler = maker;
    SilentProgress silent;
    Replayed result;
    result.report = replay(read_session(folder / "s.knead"), options, silent, [](const std::string&) {});
    result.bytes = read_text(folder / "out.ply");
    return result;
}

TEST(LostDevice, InWhicheverCallOfAReplayTheShapeIsRight) {
    const ScratchFolder folder;
    bar_file(folder, 900);
    write_text(folder / "s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n" + wriggle);
    int calls = 0;
    const Replayed whole = replayed(folder, failing_in_call(1'000'000, &calls));
    EXPECT_TRUE(whole.report.warnings.empty());
    EXPECT_EQ(whole.report.device, "a flaky device");
    ASSERT_GE(calls, 9);
    for (int call = 1; call <= calls; ++call) {
        SCOPED_TRACE("failing in call " + std::to_string(call) + " of " + std::to_string(calls));
        const Replayed lost = replayed(folder, failing_in_call(call));
        EXPECT_EQ(lost.bytes, whole.bytes);
        EXPECT_EQ(lost.report.device, "reference");
        ASSERT_EQ(lost.report.warnings.size(), 1U);
        EXPECT_SAYS(lost.report.warnings[0], "a flaky device failed");
        EXPECT_SAYS(lost.report.warnings[0], "plain C++");
    }
}

// A device may fuse products and sums, so what came before it was lost differs in last digits from what comes
// after; of the positions, about 6 in a float, that is some 1e-6, which a drag passes on but does not grow.
TEST(LostDevice, GoesOnWithinRounding) {
    const auto devices = list_devices();
    if (devices.empty()) GTEST_SKIP() << "there is no OpenCL device";
    const ScratchFolder folder;
    SilentProgress silent;
    bar_file(folder, 900);
    write_text(folder / "s.knead", "{\"knead\":1,\"cloud\":{\"path\":\"bar.ply\"}}\n" + wriggle);
    int calls = 0;
    replayed(folder, device_failing_in_call(0, 1'000'000, &calls));
    const PointCloud whole = read_cloud(folder / "out.ply", silent);
    ASSERT_GE(calls, 9);
    for (int call = 1; call <= calls; ++call) {
        SCOPED_TRACE("failing in call " + std::to_string(call) + " of " + std::to_string(calls));
        EXPECT_EQ(replayed(folder, device_failing_in_call(0, call)).report.device, "reference");
        const PointCloud lost = read_cloud(folder / "out.ply", silent);
        ASSERT_EQ(lost.positions.size(), whole.positions.size());
        for (std::size_t i = 0; i < whole.positions.size(); ++i)
            ASSERT_NEAR(lost.positions[i], whole.positions[i], 2e-6 * 6) << i;
    }
}

TEST(LostDevice, InMidDragTheEditorGoesOnWithAWord) {
    const ScratchFolder folder;
    for (const int call : {1, 2, 5}) {
        OpenRequest request = request_for(bar_file(folder));
        request.make_upsampler = failing_in_call(call);
        LiveDocument live(request);
        wait_until_open(live);
        StepNumber step = 0;
        for (const SessionAction& handle : bar_handles()) live.post(++step, {handle});
        live.begin_drag(++step, "high", {0, 0, 2});
        PosedFrame frame;
        for (int k = 1; k <= 10; ++k) {
            live.drag_to(turned(0.1 * k));
            const std::uint64_t seen = frame.version;
            ASSERT_TRUE(wait_until([&] { return live.take_frame(frame) && frame.version > seen; }));
        }
        live.end_drag();
        live.save_cloud(folder / "saved.ply");
        live.save_session(folder / "saved.knead");
        wait_until_idle(live);
        EXPECT_EQ(live.view()->device, "reference");
        std::size_t words = 0;
        for (const Notice& notice : live.take_notices())
            if (says(notice.words, "a flaky device failed") && notice.kind == Notice::Kind::warning) ++words;
        EXPECT_EQ(words, 1U);
        std::filesystem::copy_file(folder / "saved.knead", folder / "s.knead",
                                   std::filesystem::copy_options::overwrite_existing);
        EXPECT_EQ(replayed(folder, failing_in_call(1'000'000)).bytes, read_text(folder / "saved.ply"));
    }
}

// Fails once, in a way that nobody foresaw.
class AstrayUpsampler final : public Upsampler {
public:
    AstrayUpsampler(Workers& workers, int call) : works_(make_reference_upsampler(workers)), call_(call) {}

    std::string device() const override { return "astray"; }
    std::size_t influence_bytes() const override { return works_->influence_bytes(); }
    void prepare(const UpsampleInput& input, std::size_t motions) override {
        works_->prepare(input, motions);
    }
    std::span<const Index> run(std::span<const Motion> motions, std::span<float> positions,
                               std::span<float> normals, Held /*held*/) override {
        const auto written = works_->run(motions, positions, normals, Held::nothing);
        if (--call_ == 0) throw std::logic_error("nobody foresaw this");
        return written;
    }

private:
    std::unique_ptr<Upsampler> works_;
    int call_;
};

UpsamplerChoice reference_alone(const std::string& /*request*/, Workers& workers, unsigned /*threads*/) {
    return {make_reference_upsampler(workers), {}};
}

TEST(LostDevice, AFaultThatNobodyForesawDoesNotKeepADragFromEnding) {
    for (const int call : {1, 2, 3, 4, 6}) {
        const ScratchFolder folder;
        OpenRequest request = request_for(bar_file(folder));
        request.make_upsampler = [call](const std::string&, Workers& workers, unsigned) {
            UpsamplerChoice choice;
            choice.upsampler = std::make_unique<AstrayUpsampler>(workers, call);
            return choice;
        };
        LiveDocument live(request);
        wait_until_open(live);
        StepNumber step = 0;
        for (const SessionAction& handle : bar_handles()) live.post(++step, {handle});
        live.begin_drag(++step, "high", {0, 0, 2});
        live.drag_to(turned(1.5)); // frames of 20 degrees, most of them when it ends
        live.end_drag();
        live.save_cloud(folder / "saved.ply");
        live.save_session(folder / "saved.knead");
        wait_until_idle(live);
        EXPECT_FALSE(live.status().saving) << call;
        // What was followed before stands, and is the shape.
        std::filesystem::copy_file(folder / "saved.knead", folder / "s.knead");
        EXPECT_EQ(replayed(folder, reference_alone).bytes, read_text(folder / "saved.ply")) << call;
    }
}

TEST(LostDevice, AFrameThatFailedLeavesWhatFewSamplesFollowedAsItWas) {
    const auto shape = [](int failing_call) {
        Desk desk(bar(), {}, 2, "reference", Document::Mode::real,
                  [failing_call](const std::string&, Workers& workers, unsigned) {
                      UpsamplerChoice choice;
                      choice.upsampler = std::make_unique<AstrayUpsampler>(workers, failing_call);
                      return choice;
                  });
        Document& document = desk.play(ends).document();
        SilentProgress silent;
        document.begin_drag("top", {0, 0, 2.5}, "s:1", silent);
        const auto turn_by = [&](double angle) {
            HandlePose pose;
            pose.coarse = true;
            pose.rotate = Eigen::AngleAxisd(angle, Vec3d::UnitY());
            document.drag_frame(pose, "s:1", silent);
        };
        turn_by(0.3);
        if (failing_call > 0) {
            EXPECT_THROW(turn_by(1.2), std::logic_error);
        }
        turn_by(0.6);
        document.end_drag();
        return desk.shape();
    };
    EXPECT_TRUE(same_bits(shape(2), shape(0)));
}

} // namespace
} // namespace knead::test

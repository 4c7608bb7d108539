// A region of interest: only what lies in it is handed on to the window, which may miss frames.

#include "edit/editing.h"
#include "edit/live_publisher.h"

#include <numeric>
#include <random>

namespace knead::test {
namespace {

// Takes frames as the window does, now and then.
class Window {
public:
    explicit Window(Locked<LiveShared>& shared) : shared_(shared) {}

    void take() {
        const PosedFrame before = frame_;
        shared_.with([&](LiveShared& s) {
            if (s.frame.version > frame_.version) std::swap(s.frame, frame_);
        });
        if (frame_.version == before.version) return;
        changed_since(before.version, frame_, changed_);
        if (before.version == 0) return;
        // What is not told as changed has not changed.
        LineArray<float> rebuilt = before.positions(), normals = before.normals();
        for (const PointRange& range : changed_) {
            const auto take_over = [&](const LineArray<float>& from, LineArray<float>& to) {
                std::copy(from.data() + 3 * range.first, from.data() + 3 * range.end,
                          to.data() + 3 * range.first);
            };
            take_over(frame_.positions(), rebuilt);
            take_over(frame_.normals(), normals);
        }
        EXPECT_TRUE(same_bits(rebuilt, frame_.positions()));
        EXPECT_TRUE(same_bits(normals, frame_.normals()));
    }

    std::size_t points_changed() const {
        return std::accumulate(changed_.begin(), changed_.end(), std::size_t{0},
                               [](std::size_t sum, const PointRange& r) { return sum + r.end - r.first; });
    }

    const PosedFrame& frame() const { return frame_; }
    void forget() { frame_ = {}; }

private:
    Locked<LiveShared>& shared_;
    PosedFrame frame_;
    std::vector<PointRange> changed_;
};

TEST(RegionInTheWindow, IsHandedOnWhateverFramesTheWindowMisses) {
    Settings settings;
    settings.samples = 300;
    constexpr std::size_t points = 60'000;
    Desk desk(bar(points), settings);
    SilentProgress silent;
    Workers workers(2);
    Locked<LiveShared> shared;
    LivePublisher publisher(shared, workers);
    Window window(shared);
    std::mt19937 random(3);
    std::size_t taken = 0;
    const auto show = [&](bool misses = false) {
        const auto shape = desk.document().keep_shown(silent);
        publisher.shape(shape, desk.pipeline(), {});
        if (misses && random() % 2 == 0) return;
        window.take();
        ++taken;
        ASSERT_TRUE(same_bits(window.frame().positions(), shape->positions));
        ASSERT_TRUE(same_bits(window.frame().normals(), shape->normals));
    };
    show();
    desk.document().on_frame = [&] { show(true); };
    desk.play(above("region", 1.5) + above("top", 2, "moving"));
    std::string many_frames = turn('x', 1);
    for (int degrees = 2; degrees < 20; ++degrees) many_frames += "," + turn('x', degrees);
    for (int edit = 0; edit < 3; ++edit) {
        desk.play(drag(many_frames));
        window.take();
        EXPECT_LE(window.points_changed(), edit == 0 ? points : points / 3);
        desk.play(undo); // and the shape that the window then sees
        show();
        desk.play(redo);
        show();
    }
    window.forget(); // another cloud was there for a while
    desk.play(commit);
    show();
    desk.play(drag(many_frames) + undo);
    show();
    desk.play(undo + undo + undo + undo);
    show();
    EXPECT_GT(taken, 20U);
}

} // namespace
} // namespace knead::test

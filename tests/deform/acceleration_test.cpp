#include "deform/acceleration.h"

#include "deform/bent_bar.h"

#include <cstring>

namespace knead {
namespace {

struct Bar : test::BentBar {
    SampleState after_plain(int iterations) {
        SampleState state = started();
        for (int i = 0; i < iterations; ++i) iterate(system, handles, state, workers);
        return state;
    }
};

TEST(Acceleration, ComesToTheSameShapeInAFractionOfTheIterations) {
    Bar bar;
    const SampleState settled = bar.after_plain(400);
    EXPECT_LT(bar.between(bar.after_accelerated(40), settled), 1e-7);
    EXPECT_LT(bar.between(bar.after_accelerated(10), settled),
              0.1 * bar.between(bar.after_plain(10), settled));
}

TEST(Acceleration, LeavesRestAtRest) {
    Bar bar;
    bar.handles = {{}, {}};
    for (const Vec3d& way : bar.after_accelerated(8).displacement) ASSERT_EQ(way, Vec3d::Zero());
}

TEST(Acceleration, StartsAnewOnceItForgot) {
    Bar bar;
    Acceleration used;
    SampleState state = bar.started();
    for (int i = 0; i < 7; ++i) iterate(bar.system, bar.handles, state, used, bar.workers);
    forget(used);
    SampleState again = bar.started();
    for (int i = 0; i < 7; ++i) iterate(bar.system, bar.handles, again, used, bar.workers);
    const SampleState fresh = bar.after_accelerated(7);
    for (std::size_t s = 0; s < fresh.displacement.size(); ++s)
        ASSERT_EQ(std::memcmp(fresh.displacement[s].data(), again.displacement[s].data(), 3 * sizeof(double)),
                  0);
}

TEST(Acceleration, TellsTheWayOfAPlainIteration) {
    Bar bar;
    SampleState plain = bar.started();
    SampleState accelerated = plain;
    Acceleration acceleration;
    const double way = iterate(bar.system, bar.handles, plain, bar.workers);
    EXPECT_EQ(iterate(bar.system, bar.handles, accelerated, acceleration, bar.workers), way);
    EXPECT_EQ(bar.between(plain, accelerated), 0); // nothing was known before the first
}

} // namespace
} // namespace knead

#include "deform/acceleration.h"

#include "deform/sample_rest.h"

#include <cstring>

namespace knead {
namespace {

using test::degrees;

HandleMotion bend() {
    return test::motion_about(Vec3d(1, 0, 0), 100 * degrees, Vec3d(0, 0, 0), Vec3d(0.3, -1, 0.2));
}

struct Bar {
    SampleSystem system;
    Workers workers{2};
    std::vector<HandleMotion> handles{{}, bend()};

    Bar() { EXPECT_TRUE(test::built(test::bar(1200), system).solved); }

    SampleState started() {
        SampleState state = rest_state(system);
        follow_handles(system, handles, state, workers);
        return state;
    }

    SampleState after_plain(int iterations) {
        SampleState state = started();
        for (int i = 0; i < iterations; ++i) iterate(system, handles, state, workers);
        return state;
    }

    SampleState after_accelerated(int iterations) {
        SampleState state = started();
        Acceleration acceleration;
        for (int i = 0; i < iterations; ++i) iterate(system, handles, state, acceleration, workers);
        return state;
    }

    double between(const SampleState& a, const SampleState& b) const {
        double largest = 0;
        for (std::size_t s = 0; s < a.displacement.size(); ++s)
            largest = std::max(largest, (a.displacement[s] - b.displacement[s]).norm());
        return largest / system.rest.cloud_size;
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

#pragma once
// A bar that is bent far by its end: the slow case, since all of it has to come round.

#include "deform/acceleration.h"
#include "deform/sample_rest.h"

#include <algorithm>
#include <vector>

namespace knead::test {

struct BentBar {
    SampleSystem system;
    Workers workers;
    std::vector<HandleMotion> handles{
        {}, motion_about(Vec3d(1, 0, 0), 100 * degrees, Vec3d(0, 0, 0), Vec3d(0.3, -1, 0.2))};

    explicit BentBar(SampleRest rest = bar(1200), unsigned threads = 2) : workers(threads) {
        EXPECT_TRUE(built(std::move(rest), system, threads).solved);
    }

    SampleState started() {
        SampleState state = rest_state(system);
        follow_handles(system, handles, state, workers);
        return state;
    }

    SampleState after_accelerated(int iterations) {
        SampleState state = started();
        Acceleration acceleration;
        for (int i = 0; i < iterations; ++i) iterate(system, handles, state, acceleration, workers);
        return state;
    }

    // The largest distance of a sample, over the cloud's size.
    double between(const SampleState& a, const SampleState& b) const {
        double largest = 0;
        for (std::size_t s = 0; s < a.displacement.size(); ++s)
            largest = std::max(largest, (a.displacement[s] - b.displacement[s]).norm());
        return largest / system.rest.cloud_size;
    }
};

} // namespace knead::test

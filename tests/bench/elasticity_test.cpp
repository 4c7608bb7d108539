// Poisson's ratio is what is measured. The same bars as `knead evaluate`, few samples.

#include "bench/elasticity.h"

#include "base/workers.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>

#include <cmath>

namespace {

using namespace knead;

TEST(Elasticity, IsTheRatioMeasuredOnAStretch) {
    Workers workers(2);
    const auto upsampler = make_reference_upsampler(workers);
    SilentProgress progress;
    const std::optional<std::uint64_t> counts[] = {200U};
    const auto results = evaluate_elasticity(counts, workers, *upsampler, progress);
    ASSERT_FALSE(results.empty());
    for (const StretchResult& result : results) {
        SCOPED_TRACE((result.solid ? "solid, " : "shell, ") + std::to_string(result.asked));
        EXPECT_NEAR(result.measured, result.asked, poisson_bar);
        EXPECT_TRUE(result.at_rest);
        EXPECT_GT(result.along, 1.25); // it was pulled
    }
}

TEST(SlabStretch, IsThatOfALinearMap) {
    std::vector<float> rest, posed;
    for (int i = 0; i < 300; ++i) {
        const float x = std::sin(static_cast<float>(i)), y = std::cos(2.3F * static_cast<float>(i));
        const float z = std::sin(0.7F * static_cast<float>(i));
        rest.insert(rest.end(), {x, y, z});
        posed.insert(posed.end(), {0.9F * x + 1, 0.9F * y, 1.3F * z - 2});
    }
    const SlabStretch slab = slab_stretch(rest, posed, 0.8);
    EXPECT_NEAR(slab.along, 1.3, 1e-5);
    EXPECT_NEAR(slab.across, 0.9, 1e-5);
    EXPECT_EQ(slab_stretch(rest, posed, -1).along, 1); // no points
}

} // namespace

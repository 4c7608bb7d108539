// Which chunks of points a change reaches.

#include "render/chunks.h"

#include <gtest/gtest.h>

#include <set>

namespace knead::test {
namespace {

TEST(Chunks, WithChangedPointsAreThoseTheyLieInEachOnce) {
    const std::vector<std::vector<PointRange>> cases = {{},
                                                        {{0, 1}},
                                                        {{1023, 1024}, {1024, 1025}},
                                                        {{0, 3000}, {3000, 3100}, {3101, 3102}, {9000, 9001}},
                                                        {{100, 100}, {5000, 5000}},
                                                        {{512, 20'000}}};
    std::vector<Index> numbers = {7, 8, 9}; // written over
    for (const std::vector<PointRange>& ranges : cases) {
        std::set<Index> expected;
        for (const PointRange& range : ranges)
            for (std::size_t i = range.first; i < range.end; ++i)
                expected.insert(static_cast<Index>(i / points_in_chunk));
        chunks_with(ranges, numbers);
        EXPECT_EQ(numbers, std::vector<Index>(expected.begin(), expected.end()));
    }
}

} // namespace
} // namespace knead::test

// Orders that follow no direction: permutations that depend on nothing but the numbers.

#include "graph/scrambled.h"

#include <gtest/gtest.h>

#include <cstddef>

namespace knead {
namespace {

TEST(Shuffled, IsAPermutationThatDependsOnTheNumbersAlone) {
    std::vector<Index> vertices(1000);
    for (Index v = 0; v < 1000; ++v) vertices[v] = 7 * v;
    const std::vector<Index> once = shuffled(vertices);
    EXPECT_FALSE(std::ranges::is_sorted(once));
    EXPECT_TRUE(std::ranges::is_permutation(once, vertices));
    std::ranges::reverse(vertices);
    EXPECT_EQ(shuffled(vertices), once);
}

TEST(ShuffleInRuns, LeavesNearVerticesNearEachOtherInNoDirection) {
    std::vector<Index> vertices(5000);
    for (Index v = 0; v < 5000; ++v) vertices[v] = 3 * v;
    const std::vector<Index> ascending = vertices;
    shuffle_in_runs(vertices);
    std::size_t rises = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        EXPECT_EQ(vertices[i] / 3 / 1024, i / 1024);
        rises += i > 0 && vertices[i] > vertices[i - 1] ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(rises), 2500,
                150); // of a random order: half, within 7 standard deviations
    EXPECT_TRUE(std::ranges::is_permutation(vertices, ascending));
    std::vector<Index> backwards = vertices;
    std::ranges::reverse(backwards);
    shuffle_in_runs(backwards);
    EXPECT_EQ(backwards, vertices);
}

} // namespace
} // namespace knead

#include "graph/local_spacing.h"

#include "graph/neighbors.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knead::test {
namespace {

// A square of points, as far apart as told, from there on.
void add_square(std::vector<float>& positions, float from, float step) {
    for (int y = 0; y < 20; ++y)
        for (int x = 0; x < 20; ++x)
            positions.insert(positions.end(),
                             {from + step * static_cast<float>(x), step * static_cast<float>(y), 0.0f});
}

std::vector<float> spacing_of(const std::vector<float>& positions) {
    Workers workers(2);
    SilentProgress progress;
    return local_spacing(neighbor_graph(positions, 6, workers, progress), positions, workers);
}

TEST(LocalSpacing, FollowsTheDensity) {
    std::vector<float> positions;
    add_square(positions, 0, 1);
    add_square(positions, 1000, 2);
    const std::vector<float> spacing = spacing_of(positions);
    // Inside a square the fifth nearest is one of the diagonal ones.
    EXPECT_NEAR(spacing[10 * 20 + 10], std::sqrt(2.0), 1e-4);
    EXPECT_NEAR(spacing[400 + 10 * 20 + 10], 2 * std::sqrt(2.0), 1e-3);
}

TEST(LocalSpacing, OfAStrayPointIsNotThatOfASparseSurface) {
    std::vector<float> positions;
    add_square(positions, 0, 1);
    positions.insert(positions.end(), {10, 10, 30});
    const std::vector<float> spacing = spacing_of(positions);
    EXPECT_LT(spacing[400], 3);
    for (std::size_t v = 0; v < 400; ++v) EXPECT_LT(spacing[v], 3) << v; // its links back change nothing
}

TEST(LocalSpacing, OfStraysAmongThemselvesIsLittleMoreThanElsewhere) {
    std::vector<float> positions;
    add_square(positions, 0, 1);
    for (int i = 0; i < 10; ++i)
        positions.insert(positions.end(), {1000 + 50 * static_cast<float>(i), 0, static_cast<float>(i * i)});
    const std::vector<float> spacing = spacing_of(positions);
    for (std::size_t v = 400; v < spacing.size(); ++v) EXPECT_LT(spacing[v], 4) << v;
}

// As a scanner draws them far away: the fifth nearest is three steps along the line.
TEST(LocalSpacing, OfALineIsLittleMoreThanItsStep) {
    std::vector<float> positions;
    for (int line = 0; line < 8; ++line)
        for (int i = 0; i < 50; ++i)
            positions.insert(positions.end(), {static_cast<float>(i), 20.0f * static_cast<float>(line), 0});
    const std::vector<float> spacing = spacing_of(positions);
    for (std::size_t v = 0; v < spacing.size(); ++v) {
        EXPECT_LT(spacing[v], 2) << v;
        EXPECT_GE(spacing[v], 1) << v;
    }
}

TEST(LocalSpacing, OfAFarEndIsAFewOfWhatIsUsual) {
    std::vector<float> positions;
    add_square(positions, 0, 1);
    add_square(positions, 1000, 1);
    add_square(positions, 2000, 10);
    const std::vector<float> spacing = spacing_of(positions);
    const float usual = spacing[10 * 20 + 10];
    for (std::size_t v = 800; v < spacing.size(); ++v) {
        EXPECT_LE(spacing[v], 3.001f * usual) << v;
        EXPECT_GT(spacing[v], 2 * usual) << v;
    }
}

TEST(LocalSpacing, IsNothingForAPointAlone) {
    EXPECT_EQ(spacing_of({0, 0, 0}), std::vector{0.0f});
    EXPECT_TRUE(spacing_of({}).empty());
}

} // namespace
} // namespace knead::test

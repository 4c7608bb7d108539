// A stray point, or a scanner's "nothing was seen", does not decide where a cloud's floats are exact.

#include "cloud/main_part.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace knead {
namespace {

// Points in a cube of edge 2 around (100, 0, 0).
std::vector<float> crowd(std::size_t points) {
    std::mt19937 random(1);
    std::uniform_real_distribution<float> coordinate(-1, 1);
    std::vector<float> positions;
    for (std::size_t i = 0; i < points; ++i) {
        positions.push_back(100 + coordinate(random));
        positions.push_back(coordinate(random));
        positions.push_back(coordinate(random));
    }
    return positions;
}

PointCloud with_stray(std::vector<float> positions, float x) {
    positions.insert(positions.end(), {x, 0, 0});
    return make_cloud(positions);
}

TEST(MainPart, LeavesWhatIsTooFarOffOutOfEveryComputation) {
    const std::vector<float> positions = crowd(1000);
    const PointCloud plain = make_cloud(positions);
    for (const float x : {1e5F, -1e7F, 1e20F, std::numeric_limits<float>::max()}) {
        const PointCloud cloud = with_stray(positions, x);
        EXPECT_EQ(cloud.origin, plain.origin) << x;
        EXPECT_FALSE(is_finite(cloud, 1000)) << x;
        EXPECT_EQ(cloud.file_position(1000).x(), static_cast<double>(x)) << "its own value stays";
        for (std::size_t i = 0; i < 3000; ++i) ASSERT_EQ(cloud.positions[i], plain.positions[i]);
        EXPECT_EQ(bounds_of(cloud).finite_points, 1000U);
    }
}

TEST(MainPart, KeepsTheOriginNearWhereMostPointsAre) {
    const PointCloud cloud = with_stray(crowd(1000), 5000);
    EXPECT_TRUE(is_finite(cloud, 1000));
    EXPECT_LT((cloud.origin - Vec3d(100, 0, 0)).norm(), 0.2);
    const PointCloud wide = with_stray(crowd(1000), 200); // as the box says, as ever
    EXPECT_NEAR(wide.origin.x(), 149.5, 0.01);
}

TEST(MainPart, SaysNothingOfFewPointsOrOfOnePlace) {
    EXPECT_TRUE(is_finite(with_stray(crowd(100), 1e7F), 100));
    std::vector<float> one_place(3 * 1000, 2.0F);
    EXPECT_TRUE(is_finite(with_stray(one_place, 1e7F), 1000));
    EXPECT_EQ(main_part_of(make_cloud(one_place), 1000).size, 0);
}

TEST(MainPart, KeepsTheFiniteCoordinatesOfPointsThatAreNot) {
    std::vector<float> positions = crowd(1000);
    positions[4] = std::numeric_limits<float>::quiet_NaN();
    const PointCloud cloud = make_cloud(positions);
    EXPECT_TRUE(std::isfinite(cloud.positions[3]));
    EXPECT_TRUE(std::isnan(cloud.positions[4]));
}

} // namespace
} // namespace knead

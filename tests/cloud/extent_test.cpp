#include "cloud/extent.h"

#include "base/types.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace knead {
namespace {

void append(std::vector<float>& positions, const Vec3d& p) {
    for (const double coordinate : p) positions.push_back(static_cast<float>(coordinate));
}

// 20 × 20 × 20 points that fill a box of 1 × 2 × 3 evenly, turned.
std::vector<float> box(const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
    std::vector<float> positions;
    for (int i = 0; i < 8000; ++i)
        append(positions,
               turn * Vec3d((i % 20 + 0.5) / 20, (i / 20 % 20 + 0.5) / 10, (i / 400 + 0.5) * 3 / 20));
    return positions;
}

double size_of(const std::vector<float>& positions) {
    return cloud_size(positions, std::vector<double>(positions.size() / 3, 1));
}

TEST(CloudSize, IsNearlyTheDiagonalOfABoxThatIsFilledEvenly) {
    // Without the outermost twentieth, which is its corners.
    EXPECT_NEAR(size_of(box()), std::sqrt(14.0), 0.06 * std::sqrt(14.0));
}

TEST(CloudSize, DoesNotTurnWithTheAxesNorGrowWithStrays) {
    const double size = size_of(box());
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized()));
    EXPECT_NEAR(size_of(box(turn)), size, 0.01 * size); // the median is told along the axes
    std::vector<float> stray = box();
    for (int i = 0; i < 300; ++i) stray.push_back(1000);
    EXPECT_NEAR(size_of(stray), size, 0.02 * size);
}

// As if the second had been scanned at ten times the density.
TEST(CloudSize, CountsWhatPointsStandFor) {
    std::vector<float> positions = box();
    std::vector<double> area(8000, 1);
    for (std::size_t i = 0; i < 8000; ++i) {
        const Vec3d p = point_at(positions, i);
        if (p.z() < 2) continue;
        area[i] = 0.1;
        for (int copy = 1; copy < 10; ++copy) {
            append(positions, p);
            area.push_back(0.1);
        }
    }
    const double size = size_of(box());
    EXPECT_NEAR(cloud_size(positions, area), size, 1e-4 * size);
    EXPECT_LT(size_of(positions), 0.9 * size);
    for (double& each : area) each *= 1e-9; // in another unit
    EXPECT_NEAR(cloud_size(positions, area), size, 1e-4 * size);
}

TEST(CloudSize, IsNotThatOfAFewPointsThatSayTheyStandForAll) {
    std::vector<float> positions = box();
    std::vector<double> area(8000, 1);
    for (int i = 0; i < 5; ++i) {
        append(positions, Vec3d(1000, 1000 + i, 0));
        area.push_back(1e6);
    }
    const double size = size_of(box());
    EXPECT_NEAR(cloud_size(positions, area), size, 0.02 * size);
}

TEST(CloudSize, IsTheSameInAnyOrder) {
    const std::vector<float> positions = box();
    std::vector<float> backwards;
    for (std::size_t i = 8000; i-- > 0;) append(backwards, point_at(positions, i));
    EXPECT_NEAR(size_of(backwards), size_of(positions), 1e-9 * size_of(positions));
}

TEST(CloudSize, IsPositive) {
    EXPECT_EQ(size_of({}), 1);
    EXPECT_GT(size_of({1, 2, 3, 1, 2, 3}), 0);
    const std::vector<float> positions = box();
    EXPECT_EQ(cloud_size(positions, std::vector<double>(8000, 0)), size_of(positions)); // no areas are known
}

} // namespace
} // namespace knead

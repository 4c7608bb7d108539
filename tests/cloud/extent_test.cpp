#include "cloud/extent.h"

#include "base/workers.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include <cmath>
#include <limits>
#include <vector>

namespace knead {
namespace {

// 20 × 20 × 20 points that fill a box of 1 × 2 × 3 evenly, turned.
std::vector<float> box(const Eigen::Quaterniond& turn = Eigen::Quaterniond::Identity()) {
    std::vector<float> positions;
    for (int i = 0; i < 8000; ++i) {
        const Vec3d p((i % 20 + 0.5) / 20, (i / 20 % 20 + 0.5) / 10, (i / 400 + 0.5) * 3 / 20);
        for (const double coordinate : turn* p) positions.push_back(static_cast<float>(coordinate));
    }
    return positions;
}

double size_of(std::vector<float> positions) {
    Workers workers(2);
    return cloud_size(positions, workers);
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

TEST(CloudSize, TellsNothingOfPointsThatAreNotFinite) {
    std::vector<float> broken = box();
    for (const float coordinate : {1.0F, std::numeric_limits<float>::quiet_NaN(), 1.0F})
        broken.push_back(coordinate);
    EXPECT_EQ(size_of(broken), size_of(box()));
    EXPECT_EQ(size_of({}), 1);
    EXPECT_GT(size_of({1, 2, 3, 1, 2, 3}), 0);
}

} // namespace
} // namespace knead

#include "edit/mirroring.h"

#include "graph/clouds.h"
#include "view/transform.h"

#include <gtest/gtest.h>

#include <numeric>

namespace knead::test {

namespace {

// A bar along z, which is like its mirror image in all three directions, and what sticks out to one side.
std::vector<float> bar_with_an_arm(float length) {
    std::vector<float> positions = shape_positions(Shape::bar, 6000);
    const std::vector<float> arm = shape_positions(Shape::bar, 900);
    for (std::size_t i = 0; i < arm.size(); i += 3) { // laid down along x
        positions.push_back(0.5F + length * (arm[i + 2] / 5 + 0.5F));
        positions.push_back(0.3F * arm[i + 1]);
        positions.push_back(2 + 0.3F * arm[i]);
    }
    return positions;
}

} // namespace

TEST(MirrorPlane, IsTheMiddleOfWhatIsLikeItsMirrorImage) {
    const std::vector<float> positions = shape_positions(Shape::bar, 6000);
    for (const int axis : {0, 1, 2}) {
        const MirrorPlane plane = mirror_plane(positions, axis, 0.06);
        EXPECT_TRUE(plane.is_middle);
        EXPECT_NEAR(plane.at, 0, 0.01);
    }
}

TEST(MirrorPlane, IsFoundThoughTheBoxIsNotInTheMiddle) {
    const MirrorPlane plane = mirror_plane(bar_with_an_arm(2), 0, 0.06);
    EXPECT_FALSE(plane.is_middle); // which is at 1
    EXPECT_NEAR(plane.at, 0, 0.03);
    EXPECT_TRUE(mirror_plane(bar_with_an_arm(2), 1, 0.06).is_middle);
}

TEST(MirrorPlane, OfFewPointsOrOfOneIsTheMiddle) {
    EXPECT_TRUE(mirror_plane(std::vector<float>{1, 2, 3}, 0, 0).is_middle);
    EXPECT_EQ(mirror_plane(std::vector<float>{1, 2, 3}, 0, 0).at, 1);
    EXPECT_EQ(mirror_plane(std::vector<float>{0, 0, 0, 2, 0, 0}, 0, 2).at, 1);
}

TEST(MirrorPlane, ShowsMotionsAsAMirrorDoes) {
    const MirrorPlane plane{1, 0.7, false};
    HandleMotion motion;
    motion.rotation = Quatd(Eigen::AngleAxisd(0.8, Vec3d(1, 2, 3).normalized()));
    motion.linear = motion.rotation.toRotationMatrix();
    motion.offset = {0.1, 0.2, 0.3};
    const Vec3d shift(0.5, -0.25, 2);
    const HandleMotion image = seen_in(reflection(plane, shift), motion);
    const auto seen = [&](Vec3d p) { return Vec3d(Vec3d(p.x(), 1.4 - p.y(), p.z()) + shift); };
    for (const Vec3d& p : {Vec3d(0, 0, 0), Vec3d(1, 2, 3), Vec3d(-1, 0.7, 2)}) {
        const Vec3d there = motion.linear * p + motion.offset;
        EXPECT_LT((image.linear * seen(p) + image.offset - seen(there)).norm(), 1e-12);
    }
    EXPECT_LT((image.rotation.toRotationMatrix() - image.linear).norm(), 1e-12);
}

// Two legs under a bar, one of them set forward.
TEST(PartAcross, IsFoundWhereItStandsOtherwise) {
    std::vector<float> positions = shape_positions(Shape::bar, 6000);
    const std::size_t trunk = positions.size() / 3;
    const std::vector<float> leg = shape_positions(Shape::bar, 500);
    for (const float side : {-1.0F, 1.0F})
        for (std::size_t i = 0; i < leg.size(); i += 3) {
            positions.push_back(side * (0.3F + 0.2F * leg[i]));
            positions.push_back(0.2F * leg[i + 1] + (side > 0 ? 0.4F : 0.0F));
            positions.push_back(-3.4F + 0.3F * leg[i + 2] + (side > 0 ? 0.1F : 0.0F));
        }
    std::vector<Index> points;
    const auto half = static_cast<Index>((positions.size() / 3 - trunk) / 2);
    for (Index i = 0; i < half; ++i)
        if (positions[3 * (trunk + i) + 2] < -3.4F) points.push_back(static_cast<Index>(trunk) + i);
    std::vector<Index> ordered(positions.size() / 3);
    std::iota(ordered.begin(), ordered.end(), 0U);
    const PartAcross across = part_across({positions, ordered}, points, {0, 0, true}, 0.06);
    EXPECT_NEAR(across.shift.y(), 0.4, 0.05);
    EXPECT_NEAR(across.shift.z(), 0.1, 0.1);
    EXPECT_GT(across.points.size(), points.size() / 2);
    for (const Index i : across.points) EXPECT_GE(i, trunk + half) << "it is the other leg's";
}

} // namespace knead::test

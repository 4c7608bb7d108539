// Where the poses of handles send points.

#include "edit/handle_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <random>

namespace knead {
namespace {

double largest_difference(const HandleMotion& a, const HandleMotion& b) {
    return std::max({(a.linear - b.linear).cwiseAbs().maxCoeff(), (a.offset - b.offset).cwiseAbs().maxCoeff(),
                     (a.rotation.coeffs() - b.rotation.coeffs()).cwiseAbs().maxCoeff()});
}

TEST(HandleMotions, ComeBackFromTheirPoses) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Vec3d(any(random), any(random), any(random)); };
    const auto rotation = [&] {
        return Quatd(any(random), any(random), any(random), any(random)).normalized();
    };
    for (int i = 0; i < 1000; ++i) {
        HandleMotion motion;
        motion.rotation = rotation();
        const Mat3d axes = rotation().toRotationMatrix();
        const Vec3d scale = vector().array().exp();
        motion.linear = motion.rotation.toRotationMatrix() * axes * scale.asDiagonal() * axes.transpose();
        motion.offset = vector();
        const Vec3d pivot = vector(), origin = vector();
        const HandleMotion back = motion_of(pose_of(motion, pivot, origin), pivot, origin, motion);
        ASSERT_LT(largest_difference(back, motion), 1e-12);
    }
}

TEST(HandleMotions, KeepTheirTurnsThroughAnUnequalScale) {
    Transform turn, stretch;
    turn.angle = std::numbers::pi / 18;
    stretch.scale = {1, 1, 2}; // along the axis of the turns
    HandleMotion motion;
    for (int degrees = 10; degrees <= 720; degrees += 10) {
        motion = followed_by(motion, turn);
        const Quatd stretched = followed_by(motion, stretch).rotation;
        ASSERT_LT((stretched.coeffs() - motion.rotation.coeffs()).norm(), 1e-9) << degrees;
    }
    EXPECT_NEAR(motion.rotation.w(), 1, 1e-9); // twice round
}

// The one comes back by another way than it went, and the other with it, in spite of rounding.
TEST(GoneAlong, BackAtRestIsAtRest) {
    HandlePose there;
    there.rotate = Quatd(0.9, 0.1, 0.3, 0.2);
    there.translate = {0.3, -1, 2};
    const HandleMotion rest;
    const HandleMotion dragged = motion_of(there, {1, 2, 3}, Vec3d::Zero(), rest);
    const HandleMotion taken = gone_along(rest, rest, dragged, rest);
    EXPECT_TRUE(leaves_rest(taken));
    EXPECT_TRUE(is_at_rest(gone_along(taken, dragged, rest, taken)));
}

} // namespace
} // namespace knead

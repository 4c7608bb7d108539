// Who holds a point, and what becomes of the poses of handles.

#include "edit/handles.h"

#include "graph/point_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>
#include <random>

namespace knead {
namespace {

// --- Labels

Handle holding(std::vector<Index> points, HandleRole role = HandleRole::moving) {
    Handle handle;
    handle.role = role;
    handle.points = std::make_shared<const std::vector<Index>>(std::move(points));
    return handle;
}

struct Labelled {
    PointOrder order;
    HandleLabels labels;

    Labelled(const std::vector<Handle>& handles, const std::vector<float>& positions) {
        Workers workers(2);
        SilentProgress progress;
        order = order_points(positions, workers, progress);
        label_points(handles, order, positions.size() / 3, workers, labels);
    }
};

TEST(HandleLabels, AreTheSameForAnyNumberOfHandles) {
    constexpr Index points = 300;
    std::vector<float> positions(3 * points, 0);
    for (Index i = 0; i < points; ++i) positions[3 * i] = static_cast<float>(i);
    for (const Index count : {2U, 254U, 255U, 256U}) {
        std::vector<Index> region(280);
        std::iota(region.begin(), region.end(), Index{0});
        std::vector<Handle> handles{holding(region, HandleRole::region_of_interest)};
        for (Index h = 1; h < count; ++h) handles.push_back(holding({h}));
        const Labelled found(handles, positions);
        EXPECT_EQ(found.labels.outside, count);
        for (Index i = 0; i < points; ++i) {
            const Index point = found.order.file_index[i];
            const bool is_held = point >= 1 && point < count;
            const Index expected = is_held ? point : point < 280 ? no_index : found.labels.outside;
            ASSERT_EQ(found.labels.point[i], expected) << "point " << point << " of " << count << " handles";
        }
    }
}

TEST(HandleLabels, OfAHandleBeatTheOutsideWherePointsCoincide) {
    const std::vector<Handle> handles{holding({2}, HandleRole::region_of_interest),
                                      holding({0}, HandleRole::fixed)};
    const Labelled found(handles, {1, 0, 0, 1, 0, 0, 5, 0, 0});
    ASSERT_EQ(found.order.vertices(), 2U);
    EXPECT_EQ(found.labels.vertex[found.order.file_index[0] == 2 ? 1 : 0], 1U);
}

// --- Motions

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
        const HandleMotion back = motion_of(pose_of(motion, pivot, origin), pivot, origin, motion.rotation);
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

} // namespace
} // namespace knead

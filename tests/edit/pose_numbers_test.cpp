// The pose of a handle in numbers, and what typing one of them does.

#include "edit/pose_numbers.h"

#include "edit/handle_motion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace knead {
namespace {

constexpr double degree = std::numbers::pi / 180;

Quatd turned_by(const Vec3d& degrees) {
    const auto about = [&](int axis) {
        return Quatd(Eigen::AngleAxisd(degrees[axis] * degree, Vec3d::Unit(axis)));
    };
    return about(2) * about(1) * about(0);
}

Transform turn(int axis, double degrees) {
    Transform transform;
    transform.axis = glm::dvec3(0.0);
    transform.axis[axis] = 1;
    transform.angle = degrees * degree;
    return transform;
}

Vec3d after(const Transform& transform, const Vec3d& point) {
    const glm::dvec3 there = transformed(transform, {point.x(), point.y(), point.z()});
    return {there.x, there.y, there.z};
}

struct Case {
    HandleMotion motion;
    Vec3d pivot;
};

// Any pose that drags along the handle's own axes come to.
Case any_case(std::mt19937& random) {
    std::uniform_real_distribution<double> any(-1, 1);
    const auto vector = [&] { return Vec3d(any(random), any(random), any(random)); };
    Transform size, rest = turn(0, 90 * any(random));
    size.scale = {std::exp(any(random)), std::exp(any(random)), std::exp(any(random))};
    const Vec3d axis = vector().normalized(), shift = vector(), pivot = vector();
    rest.axis = {axis.x(), axis.y(), axis.z()};
    rest.shift = {shift.x(), shift.y(), shift.z()};
    rest.pivot = size.pivot = {pivot.x(), pivot.y(), pivot.z()};
    return {followed_by(followed_by({}, size), rest), pivot + shift};
}

double& number_in(PoseNumbers& numbers, PoseRow row, int axis) {
    switch (row) {
    case PoseRow::place:
        return numbers.place[axis];
    case PoseRow::moved:
        return numbers.moved[axis];
    case PoseRow::turned:
        return numbers.turned[axis];
    default:
        return numbers.scaled[axis];
    }
}

double largest_difference(const PoseNumbers& a, const PoseNumbers& b) {
    return std::max({(a.place - b.place).cwiseAbs().maxCoeff(), (a.moved - b.moved).cwiseAbs().maxCoeff(),
                     (a.turned - b.turned).cwiseAbs().maxCoeff(),
                     (a.scaled - b.scaled).cwiseAbs().maxCoeff()});
}

TEST(Angles, AreThoseNearestToTheOnesBefore) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> any(-900, 900), near(-20, 20);
    for (int i = 0; i < 2000; ++i) {
        Vec3d degrees(any(random), any(random), any(random));
        const double off = std::abs(std::remainder(degrees.y() - 90, 180));
        if (off < 25) continue; // where other angles are as near
        const Vec3d before = degrees + Vec3d(near(random), near(random), near(random));
        const Vec3d found = angles_near(turned_by(degrees), before * degree) / degree;
        ASSERT_LT((found - degrees).cwiseAbs().maxCoeff(), 1e-6) << i;
    }
}

TEST(Angles, MakeTheRotationAlsoWhereYIsARightAngle) {
    for (const double y : {90.0, -90.0, 450.0, 89.9999999, 90.000001, 270.0})
        for (const double x : {0.0, 30.0, -170.0}) {
            const Quatd rotation = turned_by({x, y, 50});
            const Vec3d before(x * degree, y * degree, 0);
            const Vec3d found = angles_near(rotation, before) / degree;
            EXPECT_NEAR(turned_by(found).angularDistance(rotation), 0, 1e-6) << x << " " << y;
            if (std::remainder(y - 90, 180) == 0) {
                EXPECT_NEAR(found.x(), x, 1e-9) << y;
            }
        }
}

TEST(Angles, CountWholeTurnsOfDragsAndOfFrames) {
    for (int axis = 0; axis < 3; ++axis) {
        HandleMotion dragged = followed_by({}, turn(axis, 765));
        EXPECT_NEAR(dragged.turned[axis], 765 * degree, 1e-9);
        dragged = followed_by(dragged, turn(axis, -1000));
        EXPECT_NEAR(dragged.turned[axis], -235 * degree, 1e-9);
        HandleMotion motion;
        for (int step = 1; step <= 20; ++step) {
            HandlePose pose;
            pose.rotate = turned_by(40.0 * step * Vec3d::Unit(axis));
            motion = motion_of(pose, Vec3d::Zero(), Vec3d::Zero(), motion);
            ASSERT_NEAR(motion.turned[axis], 40 * step * degree, 1e-9) << axis;
        }
        EXPECT_EQ(motion_of({}, Vec3d::Zero(), Vec3d::Zero(), motion).turned, Vec3d::Zero())
            << "at rest again";
    }
}

TEST(PoseNumbers, AreThoseOfTheDragsThatMadeThem) {
    Transform size, move;
    size.scale = {1.5, 2, 0.5};
    size.pivot = move.pivot = {1, 2, 3};
    move.shift = {0.5, 0, -1};
    move.axis = {0, 0, 1};
    move.angle = 30 * degree;
    const PoseNumbers numbers = numbers_of(followed_by(followed_by({}, size), move), {1.5, 2, 2});
    EXPECT_LT(largest_difference(numbers,
                                 {Vec3d(1.5, 2, 2), Vec3d(0.5, 0, -1), Vec3d(0, 0, 30), Vec3d(1.5, 2, 0.5)}),
              1e-9);
}

TEST(PoseNumbers, BecomeWhatIsTypedOneByOne) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(0.2, 3);
    for (int i = 0; i < 200; ++i) {
        const auto [motion, pivot] = any_case(random);
        for (const PoseRow row : {PoseRow::place, PoseRow::moved, PoseRow::turned, PoseRow::scaled})
            for (int axis = 0; axis < 3; ++axis) {
                PoseNumbers wanted = numbers_of(motion, pivot);
                const double change = row == PoseRow::turned ? 400 * any(random) : any(random);
                const double value = row == PoseRow::scaled ? change : number_in(wanted, row, axis) + change;
                number_in(wanted, row, axis) = value;
                if (row == PoseRow::place) wanted.moved[axis] += change;
                if (row == PoseRow::moved) wanted.place[axis] += change;
                const Transform transform = transform_to(motion, pivot, row, axis, value);
                const PoseNumbers found = numbers_of(followed_by(motion, transform), after(transform, pivot));
                ASSERT_LT(largest_difference(found, wanted), 1e-6)
                    << i << " row " << static_cast<int>(row) << " axis " << axis;
            }
    }
}

// A stretch along the world's axes of what was turned before is none along its own.
TEST(PoseNumbers, OfAShearedHandleHaveTheFactorThatIsTyped) {
    Transform along_x;
    along_x.scale = {2, 1, 1};
    const HandleMotion motion = followed_by(followed_by({}, turn(2, 40)), along_x);
    PoseNumbers wanted = numbers_of(motion, Vec3d::Zero());
    wanted.scaled.y() = 3;
    const Transform transform = transform_to(motion, Vec3d::Zero(), PoseRow::scaled, 1, 3);
    const PoseNumbers found = numbers_of(followed_by(motion, transform), Vec3d::Zero());
    EXPECT_LT((found.scaled - wanted.scaled).cwiseAbs().maxCoeff(), 1e-9);
    EXPECT_LT((found.place - wanted.place).cwiseAbs().maxCoeff(), 1e-12);
}

} // namespace
} // namespace knead

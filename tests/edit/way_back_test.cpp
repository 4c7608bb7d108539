// The way of a handle back to rest: what was wound up is unwound.

#include "edit/way_back.h"

#include <gtest/gtest.h>

#include <cmath>

namespace knead {
namespace {

constexpr double pi = std::numbers::pi;
const Vec3d middle(1, 2, 3), origin(10, 0, 0);

HandleMotion turned_on(const HandleMotion& before, const Vec3d& axis, double angle) {
    Transform turn;
    turn.pivot = {1, 2, 3};
    turn.axis = {axis.x(), axis.y(), axis.z()};
    turn.angle = angle;
    return followed_by(before, turn);
}

// So many steps of 10° about an axis, on top of what was turned before.
void wind(std::vector<HandleMotion>& way, const Vec3d& axis, int steps) {
    for (int k = 0; k < std::abs(steps); ++k)
        way.push_back(
            turned_on(way.empty() ? HandleMotion{} : way.back(), axis, (steps < 0 ? -1 : 1) * pi / 18));
}

// What the frames turn in all, none of them more than it may.
double turned_in_all(const DragLine& line, const HandleMotion& start) {
    HandleMotion before = start;
    double sum = 0;
    for (const HandlePose& pose : line.frames) {
        const HandleMotion motion = motion_of(pose, line.pivot, origin, before);
        const double turn = 2 * std::acos(std::min(1.0, before.rotation.dot(motion.rotation)));
        EXPECT_LE(turn, widest_turn * 1.001);
        sum += turn;
        before = motion;
    }
    EXPECT_NEAR(before.rotation.dot(Quatd::Identity()), 1, 1e-12) << "and not its negative";
    return sum;
}

bool is_rest(const HandlePose& pose) {
    return pose.translate == Vec3d::Zero() && pose.scale == Vec3d::Ones() &&
           pose.rotate.coeffs() == Quatd::Identity().coeffs();
}

TEST(WayBack, TwoTurnsAreUnwoundByTwoTurns) {
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitZ(), 72);
    const DragLine line = way_back("ear", way, middle, origin);
    EXPECT_NEAR(turned_in_all(line, way.back()), 4 * pi, 1e-6);
    EXPECT_LE(line.frames.size(), 45U);
    EXPECT_TRUE(is_rest(line.frames.back()));
}

TEST(WayBack, TheWayThereIsWoundUpAsOftenAndEndsWhereItDid) {
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitZ(), 72);
    wind(way, Vec3d::UnitX(), 4);
    const DragLine line = way_there("ear", way, middle, origin);
    HandleMotion motion;
    double turned = 0;
    for (const HandlePose& pose : line.frames) {
        const HandleMotion next = motion_of(pose, line.pivot, origin, motion);
        turned += 2 * std::acos(std::min(1.0, motion.rotation.dot(next.rotation)));
        motion = next;
    }
    EXPECT_NEAR(turned, 4 * pi, 40 * pi / 180); // corners are cut
    EXPECT_GT(motion.rotation.dot(way.back().rotation), 1 - 1e-12) << "and not its negative";
    EXPECT_LT((motion.linear - way.back().linear).norm() + (motion.offset - way.back().offset).norm(), 1e-9);
}

TEST(WayBack, ThreeQuartersAreNotCutShort) {
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitX(), 27);
    EXPECT_NEAR(turned_in_all(way_back("ear", way, middle, origin), way.back()), 1.5 * pi, 1e-6);
}

TEST(WayBack, DetoursThatCameBackAre) {
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitX(), 9);
    wind(way, Vec3d::UnitX(), -9);
    wind(way, Vec3d::UnitY(), 6);
    wind(way, Vec3d::UnitZ(), 3);
    EXPECT_LT(turned_in_all(way_back("ear", way, middle, origin), way.back()), 0.5 * pi);
}

TEST(WayBack, TurnsAboutTwoAxesGoBackOneAfterTheOther) {
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitX(), 36);
    wind(way, Vec3d::UnitY(), 36);
    EXPECT_NEAR(turned_in_all(way_back("ear", way, middle, origin), way.back()), 4 * pi, 0.1)
        << "though the handle lies as at rest";
}

TEST(WayBack, AShiftAndAScaleGoBackInOneFrame) {
    Transform change;
    change.shift = {3, 0, 1};
    change.scale = {2, 1, 1};
    const std::vector<HandleMotion> way{followed_by(HandleMotion{}, change)};
    const DragLine line = way_back("ear", way, middle, origin);
    ASSERT_EQ(line.frames.size(), 1U);
    EXPECT_TRUE(is_rest(line.frames[0]));
    EXPECT_EQ(way_back("ear", {}, middle, origin).frames.size(), 1U);
}

// What Reset has unwound is not wound up again.
TEST(WayBack, WhatWasGoneBackAlreadyIsNotGoneAgain) {
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitZ(), 72);
    const DragLine back = way_back("ear", way, middle, origin);
    for (const HandlePose& pose : back.frames) way.push_back(motion_of(pose, back.pivot, origin, way.back()));
    EXPECT_TRUE(is_back(way));
    wind(way, Vec3d::UnitZ(), 1);
    EXPECT_FALSE(is_back(way));
    EXPECT_NEAR(turned_in_all(way_back("ear", way, middle, origin), way.back()), pi / 18, 1e-6);
}

TEST(WayBack, TwoTurnsThatEndAtRestAreNotBack) {
    EXPECT_TRUE(is_back({}));
    std::vector<HandleMotion> way;
    wind(way, Vec3d::UnitZ(), 71);
    way.emplace_back(); // as a session may have it, in whole numbers
    EXPECT_FALSE(is_back(way));
    EXPECT_NEAR(turned_in_all(way_back("ear", way, middle, origin), way.back()), 4 * pi, 1e-6);
}

} // namespace
} // namespace knead

// The pose of a handle in numbers, and what typing one of them does.

#include "edit/pose_numbers.h"

#include "edit/handle_motion.h"
#include "edit/view_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

HandleMotion carried(const HandleMotion& base, const Transform& wanted) {
    CarriedMotion motion{base, base};
    carry_on(motion, wanted);
    return motion.now;
}

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

void set(PoseNumbers& numbers, PoseRow row, int axis, double value) {
    Vec3d& triple = row == PoseRow::place    ? numbers.place
                    : row == PoseRow::moved  ? numbers.moved
                    : row == PoseRow::turned ? numbers.turned
                                             : numbers.scaled;
    triple[axis] = value;
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
        HandleMotion dragged = carried({}, turn(axis, 765));
        EXPECT_NEAR(dragged.turned[axis], 765 * degree, 1e-9);
        dragged = carried(dragged, turn(axis, -1000));
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

// As the document's frames do, and as the window tells while the hand moves.
TEST(Angles, GoOnAlikeInFramesAndUnderTheHand) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> any(-1, 1);
    for (int i = 0; i < 200; ++i) {
        HandleMotion base = carried({}, turn(i % 3, 300 * any(random)));
        base = carried(base, turn((i + 1) % 3, 60 * any(random)));
        const Vec3d axis = Vec3d(any(random), any(random), any(random)).normalized();
        Transform wanted = turn(0, 700 * any(random));
        wanted.axis = {axis.x(), axis.y(), axis.z()};
        CarriedMotion hand{base, base};
        HandleMotion document = base;
        for (Transform shown; !(shown == wanted);) {
            shown = next_on_the_way(shown, wanted);
            const HandlePose pose = pose_of(followed_by(base, shown), Vec3d::Zero(), Vec3d::Zero());
            document = motion_of(pose, Vec3d::Zero(), Vec3d::Zero(), document);
        }
        carry_on(hand, wanted);
        ASSERT_LT((hand.now.turned - document.turned).cwiseAbs().maxCoeff(), 1e-6) << i;
    }
}

// But for axes that lead all but through a right angle of y, where x and z turn about the same axis.
TEST(Angles, AreAtRestAgainAfterAWholeTurnAboutAnyAxis) {
    std::mt19937 random(13);
    std::uniform_real_distribution<double> any(-1, 1);
    int others = 0;
    for (int i = 0; i < 500; ++i) {
        const Vec3d axis = Vec3d(any(random), any(random), any(random)).normalized();
        Transform wanted = turn(0, 360);
        wanted.axis = {axis.x(), axis.y(), axis.z()};
        const Vec3d turned = carried({}, wanted).turned;
        const Vec3d turns = turned / (2 * std::numbers::pi);
        others += (turns - turns.array().round().matrix()).cwiseAbs().maxCoeff() > 1e-6;
    }
    EXPECT_LE(others, 5);
}

TEST(Angles, OfWhatIsNoNumberAreLeftAlone) {
    EXPECT_EQ(within_turns(std::numeric_limits<double>::infinity()), 0);
    EXPECT_NEAR(std::remainder(within_turns(1e12) - 1e12, 2 * std::numbers::pi), 0, 1e-3);
    EXPECT_LT(within_turns(1e12), 42 * std::numbers::pi);
    Transform wanted = turn(1, 30);
    wanted.shift.x = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(carried({}, wanted).turned, Vec3d::Zero());
    EXPECT_EQ(carried({}, turn(1, std::numeric_limits<double>::infinity())).turned, Vec3d::Zero());
}

TEST(Angles, AreOneTurnOnlyIfTheyMakeTheSameRotation) {
    const auto rotation = [](const Vec3d& angles) {
        return Mat3d(Eigen::AngleAxisd(angles.z(), Vec3d::UnitZ()) *
                     Eigen::AngleAxisd(angles.y(), Vec3d::UnitY()) *
                     Eigen::AngleAxisd(angles.x(), Vec3d::UnitX()));
    };
    const double right = std::numbers::pi / 2, turn = 2 * std::numbers::pi;
    const Vec3d some(0.3, right, 0.1), others(0.5, right, 0.3), below(0.3, -right, 0.1),
        back(0.1, -right, 0.3);
    EXPECT_LT((rotation(some) - rotation(others)).norm(), 1e-12);
    EXPECT_TRUE(are_one_turn(some, others));
    EXPECT_LT((rotation(below) - rotation(back)).norm(), 1e-12);
    EXPECT_TRUE(are_one_turn(below, back));
    EXPECT_FALSE(are_one_turn(some, back));
    EXPECT_FALSE(are_one_turn(some, {0.5, right, 0.1}));
    EXPECT_FALSE(are_one_turn(some, {0.3 + turn, right, 0.1})) << "a whole turn more";
    EXPECT_TRUE(are_one_turn({0.3, 0.2, 0.1}, {0.3, 0.2, 0.1}));
    EXPECT_FALSE(are_one_turn({0.3, 0.2, 0.1}, {0.5, 0.2, 0.3}));
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
                set(wanted, row, axis, value);
                if (row == PoseRow::place) wanted.moved[axis] += change;
                if (row == PoseRow::moved) wanted.place[axis] += change;
                const Transform transform = transform_to(motion, pivot, row, axis, value);
                const PoseNumbers found = numbers_of(carried(motion, transform), after(transform, pivot));
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

TEST(PoseNumbers, TakeAMoveOrAScalingBackAndNothingElse) {
    std::mt19937 random(6);
    Transform aslant; // which shears what was turned
    aslant.scale = {2, 1, 0.7};
    for (int i = 0; i < 100; ++i) {
        auto [motion, pivot] = any_case(random);
        if (i % 2 == 1) {
            motion = followed_by(motion, aslant);
            pivot = after(aslant, pivot);
        }
        const PoseNumbers before = numbers_of(motion, pivot);
        const Transform home = unmoved(motion, pivot), size = unscaled(motion, pivot);
        const PoseNumbers moved = numbers_of(followed_by(motion, home), after(home, pivot));
        EXPECT_LT((moved.place - (pivot - before.moved)).norm(), 1e-9);
        EXPECT_LT((moved.scaled - before.scaled).norm(), 1e-9);
        const HandleMotion scaled = followed_by(motion, size);
        EXPECT_LT((scaled.linear - motion.rotation.toRotationMatrix()).norm(), 1e-9) << i;
        EXPECT_LT((scaled.turned - motion.turned).norm(), 1e-6) << i;
        EXPECT_LT((numbers_of(scaled, after(size, pivot)).place - pivot).norm(), 1e-9);
    }
}

// As the document has them, after several turns of up to two rounds.
HandleMotion turned_often(std::mt19937& random, const Vec3d& pivot) {
    std::uniform_real_distribution<double> degrees(-180, 180);
    HandleMotion motion;
    const int turns = 1 + static_cast<int>(random() % 5);
    for (int k = 0; k < turns; ++k) {
        Transform one = turn(static_cast<int>(random() % 3), degrees(random) * (random() % 4 == 0 ? 4 : 1));
        one.pivot = to_glm(pivot);
        motion = carried(motion, one);
    }
    return motion;
}

// The drag of these frames, with nothing but its poses in between.
HandleMotion replayed(HandleMotion motion, const std::vector<HandleMotion>& frames, const Vec3d& pivot) {
    for (const HandleMotion& frame : frames)
        motion = motion_of(pose_of(frame, pivot, Vec3d::Zero()), pivot, Vec3d::Zero(), motion);
    return motion;
}

TEST(PoseNumbers, TakeATurnBackFrameByFrame) {
    std::mt19937 random(7);
    for (int i = 0; i < 300; ++i) {
        const Vec3d pivot(0.3, -2, 1);
        HandleMotion motion = turned_often(random, pivot);
        Transform size;
        size.pivot = to_glm(pivot);
        size.axes = to_glm(motion.rotation);
        size.scale = {2, 1, 0.5};
        const bool is_scaled = i % 2 == 1;
        if (is_scaled) motion = followed_by(motion, size);
        const std::vector<HandleMotion> frames = unturned(motion, pivot);
        ASSERT_FALSE(frames.empty());
        const HandleMotion* last = &motion;
        for (const HandleMotion& frame : frames) {
            EXPECT_LE(last->rotation.angularDistance(frame.rotation), widest_turn + 1e-6);
            EXPECT_GT(last->rotation.dot(frame.rotation), 0) << "the quaternion goes on";
            EXPECT_LT((moved_point(frame, point_at_rest(motion, pivot)) - pivot).norm(), 1e-9);
            last = &frame;
        }
        const HandleMotion back = replayed(motion, frames, pivot);
        EXPECT_LT(back.turned.norm(), 1e-6) << i;
        EXPECT_GT(back.rotation.w(), 0.999999) << i;
        if (!is_scaled)
            EXPECT_FALSE(leaves_rest(back)) << i;
        else
            EXPECT_LT((numbers_of(back, pivot).scaled - numbers_of(motion, pivot).scaled).norm(), 1e-6) << i;
    }
    EXPECT_TRUE(unturned({}, {1, 2, 3}).empty());
}

} // namespace
} // namespace knead

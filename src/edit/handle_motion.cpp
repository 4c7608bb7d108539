#include "edit/handle_motion.h"

#include "base/error.h"
#include "edit/view_vectors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knead {

namespace {

// Scales that differ from one by less are rounding.
constexpr double unit_scale = 1e-12;

// The cosine of the angle about y below which x and z cannot be told apart.
constexpr double same_axis = 1e-7;

Vec3d nearest(Vec3d angles, const Vec3d& before) {
    constexpr double whole = 2 * std::numbers::pi;
    for (int axis = 0; axis < 3; ++axis)
        angles[axis] += whole * std::round((before[axis] - angles[axis]) / whole);
    return angles;
}

// Between two rotations the angles are looked at so closely that none goes farther than this in a step, nor y
// across a right angle, near which x and z go round in next to nothing ...
constexpr double small_step = std::numbers::pi / 4;
// ... unless the step is as short as this: then y has gone through the right angle itself.
constexpr double least_step = std::numbers::pi / 1800;

// The rotation in the polar decomposition; that of unequal scales is no product of turns. Of its two
// quaternions the one that is nearer to `expected`.
Quatd rotation_in(const Mat3d& linear, const Quatd& expected) {
    const Eigen::JacobiSVD<Mat3d> svd(linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Quatd rotation = Quatd(Mat3d(svd.matrixU() * svd.matrixV().transpose())).normalized();
    if (rotation.dot(expected) < 0) rotation.coeffs() = -rotation.coeffs();
    return rotation;
}

Quatd turn_about(const glm::dvec3& axis, double angle) {
    return Quatd(Eigen::AngleAxisd(angle, to_eigen(axis)));
}

} // namespace

Vec3d angles_near(const Quatd& rotation, const Vec3d& before) {
    constexpr double half = std::numbers::pi;
    const Mat3d r = rotation.toRotationMatrix();
    const double across = std::hypot(r(0, 0), r(1, 0));
    const double y = std::atan2(-r(2, 0), across);
    if (across < same_axis) {
        const double x = before.x();
        const double z = y > 0 ? x - std::atan2(r(0, 1), r(1, 1)) : std::atan2(-r(0, 1), r(1, 1)) - x;
        return nearest({x, y, z}, before);
    }
    const Vec3d angles(std::atan2(r(2, 1), r(2, 2)), y, std::atan2(r(1, 0), r(0, 0)));
    const Vec3d one = nearest(angles, before);
    const Vec3d other = nearest({angles.x() + half, half - y, angles.z() + half}, before);
    return (one - before).squaredNorm() <= (other - before).squaredNorm() ? one : other;
}

Quatd between(const Quatd& from, const Quatd& to, double t) {
    const double angle = std::acos(std::clamp(from.dot(to), -1.0, 1.0));
    if (angle < 1e-9) return to;
    Quatd result;
    result.coeffs() = (std::sin((1 - t) * angle) * from.coeffs() + std::sin(t * angle) * to.coeffs());
    return result.normalized();
}

Vec3d angles_along(const Quatd& from, const Vec3d& angles, const Quatd& to) {
    Vec3d there = angles_near(to, angles);
    const double way = 2 * std::acos(std::clamp(from.dot(to), -1.0, 1.0));
    const bool is_near = (there - angles).cwiseAbs().maxCoeff() < small_step;
    const bool same_side = std::cos(there.y()) * std::cos(angles.y()) > 0; // of the right angle
    if (!(way >= least_step) || (is_near && same_side)) return there;
    const Quatd middle = between(from, to, 0.5);
    return angles_along(middle, angles_along(from, angles, middle), to);
}

Vec3d moved_point(const HandleMotion& motion, const Vec3d& point) {
    return motion.linear * point + motion.offset;
}

Vec3d point_at_rest(const HandleMotion& motion, const Vec3d& point) {
    return motion.linear.inverse() * (point - motion.offset);
}

Vec3d moved_on(const Vec3d& place, const HandleMotion& before, const HandleMotion& after) {
    return moved_point(after, point_at_rest(before, place));
}

HandleMotion without_rounding(HandleMotion motion, double reach) {
    const bool is_rest = (motion.linear - Mat3d::Identity()).cwiseAbs().maxCoeff() < unit_scale &&
                         motion.offset.norm() <= unit_scale * reach;
    if (is_rest) motion.linear.setIdentity(), motion.offset.setZero();
    return motion;
}

bool leaves_rest(const HandleMotion& motion) {
    return motion.linear != Mat3d::Identity() || motion.offset != Vec3d::Zero();
}

bool is_at_rest(const HandleMotion& motion) {
    return !leaves_rest(motion) && motion.rotation.w() > 0;
}

HandleMotion motion_of(const HandlePose& pose, const Vec3d& pivot, const Vec3d& origin,
                       const HandleMotion& before) {
    HandleMotion motion;
    motion.rotation = pose.rotate.normalized();
    if (motion.rotation.dot(before.rotation) < 0) motion.rotation.coeffs() = -motion.rotation.coeffs();
    const Mat3d axes = pose.axes.normalized().toRotationMatrix();
    const Mat3d stretch = axes * pose.scale.asDiagonal() * axes.transpose();
    const bool stretched = pose.scale != Vec3d::Ones();
    motion.linear = motion.rotation.toRotationMatrix();
    if (stretched) motion.linear = motion.linear * stretch;
    const Vec3d center = pivot - origin;
    motion.offset = center - motion.linear * center + pose.translate;
    if (!is_at_rest(motion)) motion.turned = angles_along(before.rotation, before.turned, motion.rotation);
    return motion;
}

HandlePose pose_of(const HandleMotion& motion, const Vec3d& pivot, const Vec3d& origin) {
    // linear = R S; what is written must give the very rotation back, whose turns are counted.
    const Mat3d rotation = motion.rotation.toRotationMatrix();
    const Mat3d stretch = rotation.transpose() * motion.linear;
    const Eigen::SelfAdjointEigenSolver<Mat3d> split(0.5 * (stretch + stretch.transpose()));
    if (!(split.eigenvalues().minCoeff() > 0))
        throw Error(Trouble::usage, "", "a handle cannot be mirrored or flattened");
    HandlePose pose;
    pose.rotate = motion.rotation;
    const Vec3d& scale = split.eigenvalues();
    if ((scale - Vec3d::Ones()).cwiseAbs().maxCoeff() > unit_scale) {
        pose.scale = scale;
        Mat3d axes = split.eigenvectors();
        if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
        if (scale.maxCoeff() - scale.minCoeff() > unit_scale) pose.axes = Quatd(axes);
    }
    const Vec3d center = pivot - origin;
    pose.translate = motion.offset - center + motion.linear * center;
    return pose;
}

HandleMotion followed_by(const HandleMotion& motion, const Transform& change) {
    const Quatd turn = turn_about(change.axis, change.angle);
    const Mat3d axes = to_eigen(change.axes).toRotationMatrix();
    const Mat3d map = turn.toRotationMatrix() * axes * to_eigen(change.scale).asDiagonal() * axes.transpose();
    const Vec3d pivot = to_eigen(change.pivot);

    HandleMotion result;
    result.linear = map * motion.linear;
    result.offset = map * (motion.offset - pivot) + pivot + to_eigen(change.shift);
    result.rotation = (turn * motion.rotation).normalized();
    result.turned = angles_along(motion.rotation, motion.turned, result.rotation);
    if (change.scale == glm::dvec3(1.0)) return result;
    const Quatd expected = result.rotation;
    result.rotation = rotation_in(result.linear, expected);
    result.turned = angles_along(expected, result.turned, result.rotation);
    return result;
}

HandleMotion gone_along(const HandleMotion& motion, const HandleMotion& from, const HandleMotion& to,
                        const HandleMotion& before) {
    const Mat3d map = to.linear * from.linear.inverse();
    HandleMotion result;
    result.linear = map * motion.linear;
    result.offset = map * (motion.offset - from.offset) + to.offset;
    if (to.linear == from.linear && to.offset == from.offset) // as it was, to the last bit
        result.linear = motion.linear, result.offset = motion.offset;
    result = without_rounding(result, motion.offset.norm() + from.offset.norm() + to.offset.norm());
    result.rotation = (to.rotation * from.rotation.conjugate() * motion.rotation).normalized();
    const bool scales = (map * map.transpose() - Mat3d::Identity()).cwiseAbs().maxCoeff() > unit_scale;
    if (scales) result.rotation = rotation_in(result.linear, result.rotation);
    if (result.rotation.dot(before.rotation) < 0) result.rotation.coeffs() = -result.rotation.coeffs();
    if (!is_at_rest(result)) result.turned = angles_along(before.rotation, before.turned, result.rotation);
    return result;
}

namespace {

double step_towards(double from, double to) {
    return from + std::clamp(to - from, -widest_turn, widest_turn);
}

// With its sign, which tells 300° from -60°.
glm::dquat turn_of(const Transform& transform) {
    return {std::cos(transform.angle / 2), std::sin(transform.angle / 2) * transform.axis};
}

bool is_one_step_off(const Transform& shown, const Transform& wanted) {
    return glm::dot(turn_of(shown), turn_of(wanted)) >= std::cos(widest_turn / 2);
}

} // namespace

Transform next_on_the_way(const Transform& shown, const Transform& wanted) {
    Transform next = wanted;
    if (shown.axis == wanted.axis || shown.angle == 0) {
        next.angle = step_towards(shown.angle, wanted.angle);
    } else if (!is_one_step_off(shown, wanted)) {
        next.angle = step_towards(shown.angle, 0);
        if (next.angle != 0) next.axis = shown.axis;
    }
    return next;
}

void carry_on(CarriedMotion& carried, const Transform& wanted) {
    if (!(wanted == wanted) || !std::isfinite(wanted.angle)) return; // no pose at all
    while (!(carried.shown == wanted)) {
        carried.shown = next_on_the_way(carried.shown, wanted);
        const Vec3d angles = carried.now.turned;
        const Quatd before = carried.now.rotation;
        carried.now = followed_by(carried.base, carried.shown);
        if (carried.now.rotation.dot(before) < 0) carried.now.rotation.coeffs() *= -1;
        carried.now.turned = angles_along(before, angles, carried.now.rotation);
    }
}

} // namespace knead

#include "edit/handle_motion.h"

#include "base/error.h"

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

Quatd turn_about(const glm::dvec3& axis, double angle) {
    return Quatd(Eigen::AngleAxisd(angle, Vec3d(axis.x, axis.y, axis.z)));
}

// Step by step, so that whole turns count.
Vec3d angles_after(const HandleMotion& motion, const Transform& change) {
    constexpr double step = 1.0; // radian
    const double steps = std::max(1.0, std::ceil(std::abs(change.angle) / step));
    Vec3d angles = motion.turned;
    for (double k = 1; k <= steps; ++k)
        angles = angles_near(turn_about(change.axis, change.angle * k / steps) * motion.rotation, angles);
    return angles;
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

bool leaves_rest(const HandleMotion& motion) {
    return motion.linear != Mat3d::Identity() || motion.offset != Vec3d::Zero();
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
    if (leaves_rest(motion)) motion.turned = angles_near(motion.rotation, before.turned);
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
    const auto vector = [](const glm::dvec3& v) { return Vec3d(v.x, v.y, v.z); };
    const Quatd turn = turn_about(change.axis, change.angle);
    const Mat3d axes = Quatd(change.axes.w, change.axes.x, change.axes.y, change.axes.z).toRotationMatrix();
    const Mat3d map = turn.toRotationMatrix() * axes * vector(change.scale).asDiagonal() * axes.transpose();
    const Vec3d pivot = vector(change.pivot);

    HandleMotion result;
    result.linear = map * motion.linear;
    result.offset = map * (motion.offset - pivot) + pivot + vector(change.shift);
    result.turned = angles_after(motion, change);
    if (change.scale == glm::dvec3(1.0)) {
        result.rotation = (turn * motion.rotation).normalized();
        return result;
    }
    // The rotation in the polar decomposition; that of unequal scales is no longer the product of the turns.
    const Eigen::JacobiSVD<Mat3d> svd(result.linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
    result.rotation = Quatd(Mat3d(svd.matrixU() * svd.matrixV().transpose())).normalized();
    const Quatd expected = turn * motion.rotation;
    if (result.rotation.dot(expected) < 0) result.rotation.coeffs() = -result.rotation.coeffs();
    result.turned = angles_near(result.rotation, result.turned);
    return result;
}

} // namespace knead

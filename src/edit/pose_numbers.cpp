#include "edit/pose_numbers.h"

#include "edit/handle_motion.h"
#include "edit/view_vectors.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include <cmath>
#include <numbers>

namespace knead {

namespace {

constexpr double degree = std::numbers::pi / 180;

// What turned by less, in radians, has not turned.
constexpr double least_turn = 1e-9;

// A stretch whose axes are off by less is along the handle's own.
constexpr double aligned = 1e-9;

// R = R_z R_y R_x: the axis about which this angle alone turns.
Vec3d axis_of_angle(const Vec3d& angles, int axis) {
    const Eigen::AngleAxisd about_y(angles.y(), Vec3d::UnitY()), about_z(angles.z(), Vec3d::UnitZ());
    if (axis == 2) return Vec3d::UnitZ();
    if (axis == 1) return about_z * Vec3d::UnitY();
    return about_z * (about_y * Vec3d::UnitX());
}

void turn_by(double angle, const Vec3d& axis, Transform& transform) {
    transform.axis = to_glm(axis);
    transform.angle = angle;
}

// `map` = Q S with S along some axes. Of what was scaled along other axes than the handle's own, a turn is
// part of what makes one of these longer and leaves the others as long as they are.
void map_by(const Mat3d& map, Transform& transform) {
    const Eigen::SelfAdjointEigenSolver<Mat3d> split(map.transpose() * map);
    Mat3d axes = split.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
    const Vec3d scale = split.eigenvalues().cwiseSqrt();
    const Eigen::AngleAxisd turn(Mat3d(map * axes * scale.cwiseInverse().asDiagonal() * axes.transpose()));
    turn_by(turn.angle(), turn.axis(), transform);
    transform.scale = to_glm(scale);
    transform.axes = to_glm(Quatd(axes));
}

bool is_sheared(const HandleMotion& motion) {
    const Mat3d stretch = motion.rotation.toRotationMatrix().transpose() * motion.linear;
    const Mat3d apart = stretch - Mat3d(stretch.diagonal().asDiagonal());
    return apart.cwiseAbs().maxCoeff() > aligned * stretch.norm();
}

void scale_to(const HandleMotion& motion, int axis, double factor, Transform& transform) {
    Vec3d longer = Vec3d::Ones();
    longer[axis] = factor / motion.linear.col(axis).norm();
    if (is_sheared(motion))
        return map_by(motion.linear * longer.asDiagonal() * motion.linear.inverse(), transform);
    transform.scale = to_glm(longer);
    transform.axes = to_glm(motion.rotation);
}

} // namespace

PoseNumbers numbers_of(const HandleMotion& motion, const Vec3d& pivot) {
    PoseNumbers numbers;
    numbers.place = pivot;
    numbers.moved = pivot - point_at_rest(motion, pivot);
    numbers.turned = motion.turned / degree;
    numbers.scaled = motion.linear.colwise().norm();
    numbers.is_sheared = is_sheared(motion);
    return numbers;
}

bool are_one_turn(const Vec3d& some, const Vec3d& others) {
    constexpr double alike = 1e-6; // radians
    const Vec3d apart = some - others;
    if (std::abs(apart.y()) > alike) return false;
    if (std::abs(std::cos(some.y())) > alike) return apart.cwiseAbs().maxCoeff() <= alike;
    return std::abs(apart.x() - std::sin(some.y()) * apart.z()) <=
           alike; // they turn against each other, or along
}

double number_in(const PoseNumbers& numbers, PoseRow row, int axis) {
    switch (row) {
    case PoseRow::place:
        return numbers.place[axis];
    case PoseRow::moved:
        return numbers.moved[axis];
    case PoseRow::turned:
        return numbers.turned[axis];
    case PoseRow::scaled:
        break;
    }
    return numbers.scaled[axis];
}

Transform transform_to(const HandleMotion& motion, const Vec3d& pivot, PoseRow row, int axis, double value) {
    const double change = value - number_in(numbers_of(motion, pivot), row, axis);
    Transform transform;
    transform.pivot = to_glm(pivot);
    switch (row) {
    case PoseRow::place:
    case PoseRow::moved:
        transform.shift[axis] = change;
        break;
    case PoseRow::turned:
        turn_by(change * degree, axis_of_angle(motion.turned, axis), transform);
        break;
    case PoseRow::scaled:
        scale_to(motion, axis, value, transform);
        break;
    }
    return transform;
}

Transform unmoved(const HandleMotion& motion, const Vec3d& pivot) {
    Transform transform;
    transform.pivot = to_glm(pivot);
    transform.shift = -to_glm(numbers_of(motion, pivot).moved);
    return transform;
}

Transform unscaled(const HandleMotion& motion, const Vec3d& pivot) {
    Transform transform;
    transform.pivot = to_glm(pivot);
    if (is_sheared(motion)) {
        map_by(motion.rotation.toRotationMatrix() * motion.linear.inverse(), transform);
    } else {
        transform.scale = to_glm(Vec3d(motion.linear.colwise().norm().cwiseInverse()));
        transform.axes = to_glm(motion.rotation);
    }
    return transform;
}

// One angle after the other, as they are about each other: each by itself leaves the others what they are.
// All at once would go past the pole, beyond which the angles of the same rotation are others.
std::vector<HandleMotion> unturned(const HandleMotion& motion, const Vec3d& pivot) {
    std::vector<HandleMotion> frames;
    HandleMotion now = motion;
    for (const int axis : {2, 1, 0}) {
        const double angle = motion.turned[axis];
        if (!(std::abs(angle) > least_turn)) continue;
        const auto count = static_cast<int>(std::ceil(std::abs(angle) / widest_turn));
        Transform step;
        step.pivot = to_glm(pivot);
        turn_by(-angle / count, axis_of_angle(now.turned, axis), step);
        for (int k = 0; k < count; ++k) frames.push_back(now = followed_by(now, step));
    }
    if (!frames.empty() && !leaves_rest(without_rounding(frames.back(), pivot.norm()))) frames.back() = {};
    return frames;
}

} // namespace knead

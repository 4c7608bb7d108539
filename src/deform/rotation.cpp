#include "deform/rotation.h"

#include <Eigen/Eigenvalues>

#include <optional>

namespace knead {

namespace {

// How strongly `near` is preferred, of the size of A: enough to decide what A leaves open, too little to be
// seen.
constexpr double preference = 1e-10;

Vec3d axial(const Mat3d& b) {
    return {b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1)};
}

// C⁻¹ v by Cramer's rule; nothing unless C is positive definite.
std::optional<Vec3d> solved_positive(const Mat3d& c, const Vec3d& v) {
    // The cofactors, C being symmetric.
    const double a00 = c(1, 1) * c(2, 2) - c(1, 2) * c(1, 2);
    const double a01 = c(0, 2) * c(1, 2) - c(0, 1) * c(2, 2);
    const double a02 = c(0, 1) * c(1, 2) - c(0, 2) * c(1, 1);
    const double a11 = c(0, 0) * c(2, 2) - c(0, 2) * c(0, 2);
    const double a12 = c(0, 1) * c(0, 2) - c(0, 0) * c(1, 2);
    const double a22 = c(0, 0) * c(1, 1) - c(0, 1) * c(0, 1);
    const double determinant = c(0, 0) * a00 + c(0, 1) * a01 + c(0, 2) * a02;
    if (!(c(0, 0) > 0 && a22 > 0 && determinant > 0)) return std::nullopt;
    return Vec3d(a00 * v[0] + a01 * v[1] + a02 * v[2], a01 * v[0] + a11 * v[1] + a12 * v[2],
                 a02 * v[0] + a12 * v[1] + a22 * v[2]) /
           determinant;
}

// Rᵀ of the quaternion (1, h), which has any length.
Mat3d turned_back(const Vec3d& h) {
    const double squared = h.squaredNorm();
    Mat3d back = (2 * h) * h.transpose();
    back.diagonal().array() += 1 - squared;
    back(0, 1) += 2 * h.z(), back(1, 0) -= 2 * h.z();
    back(2, 0) += 2 * h.y(), back(0, 2) -= 2 * h.y();
    back(1, 2) += 2 * h.x(), back(2, 1) -= 2 * h.x();
    return back * (1 / (1 + squared));
}

// Newton's method for the maximum of tr(Rᵀ A) over rotations, from `near`: with B = Rᵀ A, turning R further
// by ω changes it by ω·axial(B) - ½ ωᵀ(tr(B) I - sym(B)) ω. There is one maximum, so arriving where the
// quadratic form is positive means having found it. Nothing, if on the way it is not. The quaternion gets its
// length at the end.
std::optional<Quatd> climb(const Mat3d& a, double size, const Quatd& near) {
    Quatd rotation = near;
    Mat3d b = near.toRotationMatrix().transpose() * a;
    for (int step = 0; step < 8; ++step) {
        Mat3d curvature = -0.5 * (b + b.transpose());
        curvature.diagonal().array() += b.trace() + preference * size;
        const std::optional<Vec3d> turn = solved_positive(curvature, axial(b));
        if (!turn) return std::nullopt;
        const double squared = turn->squaredNorm();
        if (squared == 0) return step == 0 ? near : rotation.normalized();
        if (!(squared < 1)) return std::nullopt; // too far for the quadratic form to be trusted
        const Vec3d half = 0.5 * *turn;
        rotation = rotation * Quatd(1, half.x(), half.y(), half.z());
        if (squared < 1e-14) return rotation.normalized(); // the next step would be of the size of its square
        b = turned_back(half) * b;
    }
    return std::nullopt;
}

// The same maximum from anywhere: the largest eigenvector of Horn's symmetric 4×4 matrix (B. K. P. Horn,
// "Closed-form solution of absolute orientation using unit quaternions", 1987).
Quatd search(const Mat3d& a, double size, const Quatd& near) {
    Eigen::Matrix4d k;
    const Vec3d z = axial(a);
    k(0, 0) = a.trace();
    k.block<3, 1>(1, 0) = z;
    k.block<1, 3>(0, 1) = z.transpose();
    k.block<3, 3>(1, 1) = a + a.transpose() - a.trace() * Mat3d::Identity();
    const Eigen::Vector4d preferred(near.w(), near.x(), near.y(), near.z());
    k += preference * size * preferred * preferred.transpose();
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix4d> solver(k);
    Eigen::Vector4d q = solver.eigenvectors().col(3);
    if (q.dot(preferred) < 0) q = -q;
    return Quatd(q[0], q[1], q[2], q[3]).normalized();
}

} // namespace

Mat3d turn_of(const Quatd& q) {
    const double x = q.x(), y = q.y(), z = q.z(), w = q.w();
    Mat3d turn;
    turn << -2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y), //
        2 * (x * y + w * z), -2 * (x * x + z * z), 2 * (y * z - w * x),     //
        2 * (x * z - w * y), 2 * (y * z + w * x), -2 * (x * x + y * y);
    return turn;
}

Quatd nearest_rotation(const Mat3d& a, const Quatd& near) {
    const double size = a.norm();
    if (!(size > 0)) return near;
    if (const auto found = climb(a, size, near)) return *found;
    return search(a, size, near);
}

} // namespace knead

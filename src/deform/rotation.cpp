#include "deform/rotation.h"

#include <Eigen/Cholesky>
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

// Newton's method for the maximum of tr(Rᵀ A) over rotations, from `near`: with B = Rᵀ A, turning R further
// by ω changes it by ω·axial(B) - ½ ωᵀ(tr(B) I - sym(B)) ω. There is one maximum, so arriving where the
// quadratic form is positive means having found it. Nothing, if on the way it is not.
std::optional<Quatd> climb(const Mat3d& a, double size, const Quatd& near) {
    Quatd rotation = near;
    for (int step = 0; step < 8; ++step) {
        const Mat3d b = rotation.toRotationMatrix().transpose() * a;
        const Mat3d curvature =
            (b.trace() + preference * size) * Mat3d::Identity() - 0.5 * (b + b.transpose());
        const Eigen::LLT<Mat3d> factor(curvature);
        if (factor.info() != Eigen::Success) return std::nullopt;
        const Vec3d turn = factor.solve(axial(b));
        const double squared = turn.squaredNorm();
        if (squared == 0) return rotation;
        if (!(squared < 1)) return std::nullopt; // too far for the quadratic form to be trusted
        rotation = (rotation * Quatd(1, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z())).normalized();
        if (squared < 1e-14) return rotation; // the next step would be of the size of its square
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

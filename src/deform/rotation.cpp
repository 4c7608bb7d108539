#include "deform/rotation.h"

#include "base/new_processors.h"
#include "base/require.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace knead {

namespace {

// How strongly `near` is preferred, of the size of A: too little to be seen, and enough to decide what A
// leaves open. Positions are floats: of points on a line, a relative 1e-7 of noise seems to tell how they
// turn about it.
constexpr double preference = 1e-6;

Vec3d axial(const Mat3d& b) {
    return {b(2, 1) - b(1, 2), b(0, 2) - b(2, 0), b(1, 0) - b(0, 1)};
}

// Several numbers side by side, one of each rotation that is sought, in the vectors of GCC and Clang.
constexpr std::size_t lanes = 4;
using Reals = double __attribute__((vector_size(8 * lanes)));
using Truths = std::int64_t __attribute__((vector_size(8 * lanes)));

struct Vectors {
    Reals x, y, z;
};
struct Turns {
    Reals w, x, y, z;
};
struct Matrices {
    Reals of[3][3]; // row, column
};

[[gnu::always_inline]] inline bool any(const Truths& truths) {
    std::int64_t joined = 0;
    for (std::size_t k = 0; k < lanes; ++k) joined |= truths[k];
    return joined != 0;
}

[[gnu::always_inline]] inline Matrices product(const Matrices& a, const Matrices& b) {
    Matrices c;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            c.of[i][j] = a.of[i][0] * b.of[0][j] + a.of[i][1] * b.of[1][j] + a.of[i][2] * b.of[2][j];
    return c;
}

[[gnu::always_inline]] inline Turns product(const Turns& a, const Turns& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z, a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x};
}

// Rᵀ of the quaternion (w, v), which has any length.
[[gnu::always_inline]] inline Matrices turned_back(const Turns& q) {
    const Reals squared = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
    const Reals twice = 2.0 / squared;
    const Reals x = twice * q.x, y = twice * q.y, z = twice * q.z;
    const Reals xx = x * q.x, yy = y * q.y, zz = z * q.z, xy = x * q.y, xz = x * q.z, yz = y * q.z;
    const Reals wx = x * q.w, wy = y * q.w, wz = z * q.w;
    return {{{1.0 - (yy + zz), xy + wz, xz - wy},
             {xy - wz, 1.0 - (xx + zz), yz + wx},
             {xz + wy, yz - wx, 1.0 - (xx + yy)}}};
}

// C⁻¹ v by Cramer's rule for the symmetric C = (tr B + p) I - sym(B), and where C is positive definite.
[[gnu::always_inline]] inline Vectors solved(const Matrices& b, const Reals& p, const Vectors& v,
                                             Truths& is_positive) {
    const auto& of = b.of;
    const Reals trace = of[0][0] + of[1][1] + of[2][2] + p;
    const Reals c00 = trace - of[0][0], c11 = trace - of[1][1], c22 = trace - of[2][2];
    const Reals c01 = -0.5 * (of[0][1] + of[1][0]), c02 = -0.5 * (of[0][2] + of[2][0]);
    const Reals c12 = -0.5 * (of[1][2] + of[2][1]);
    const Reals a00 = c11 * c22 - c12 * c12, a01 = c02 * c12 - c01 * c22, a02 = c01 * c12 - c02 * c11;
    const Reals a11 = c00 * c22 - c02 * c02, a12 = c01 * c02 - c00 * c12, a22 = c00 * c11 - c01 * c01;
    const Reals determinant = c00 * a00 + c01 * a01 + c02 * a02;
    is_positive = (c00 > 0.0) & (a22 > 0.0) & (determinant > 0.0);
    return {(a00 * v.x + a01 * v.y + a02 * v.z) / determinant,
            (a01 * v.x + a11 * v.y + a12 * v.z) / determinant,
            (a02 * v.x + a12 * v.y + a22 * v.z) / determinant};
}

// Newton's method for the maximum of tr(Rᵀ A) over rotations, from `near`: with B = Rᵀ A, turning R further
// by ω changes it by ω·axial(B) - ½ ωᵀ(tr(B) I - sym(B)) ω. There is one maximum, so arriving where the
// quadratic form is positive means having found it. `near` receives the quaternions that were found, of any
// length; those of the others, where on the way it is not, are good for nothing. Where the first step is
// none, `near` stays to the last bit. Returns which were found.
KNEAD_FOR_NEW_PROCESSORS_TOO
void climb(const Matrices& a, const Reals& size, Turns& near, Truths& found) {
    found = Truths{};
    Truths going = ~found;
    Matrices b = product(turned_back(near), a);
    for (int step = 0; step < 8 && any(going); ++step) {
        const Vectors uphill{b.of[2][1] - b.of[1][2], b.of[0][2] - b.of[2][0], b.of[1][0] - b.of[0][1]};
        Truths is_positive;
        const Vectors turn = solved(b, preference * size, uphill, is_positive);
        const Reals squared = turn.x * turn.x + turn.y * turn.y + turn.z * turn.z;
        going &= is_positive & (squared < 1.0); // too far for the quadratic form to be trusted
        found |= going & (squared == 0.0);
        going &= ~found;
        const Turns further{Reals{} + 1.0, 0.5 * turn.x, 0.5 * turn.y, 0.5 * turn.z};
        const Turns turned = product(near, further);
        near = {going ? turned.w : near.w, going ? turned.x : near.x, going ? turned.y : near.y,
                going ? turned.z : near.z};
        found |= going & (squared < 1e-14); // the next step would be of the size of its square
        going &= ~found;
        b = product(turned_back(further), b);
    }
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

struct Sought {
    Reals sizes; // of the matrices
    Turns turns;
    Truths found;

    // One that was found; what did not turn stays to the last bit.
    void take(std::size_t lane, Quatd& to) const {
        const Quatd turned(turns.w[lane], turns.x[lane], turns.y[lane], turns.z[lane]);
        if (turned.coeffs() != to.coeffs()) to = turned.normalized();
    }
};

// The first of these, from close by; lanes beyond the end do the last one again.
Sought climbed(std::span<const Mat3d> a, std::span<const Quatd> near) {
    Sought sought;
    Matrices matrices;
    for (std::size_t k = 0; k < lanes; ++k) {
        const std::size_t at = std::min(k, near.size() - 1);
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j) matrices.of[i][j][k] = a[at](i, j);
        sought.turns.w[k] = near[at].w(), sought.turns.x[k] = near[at].x();
        sought.turns.y[k] = near[at].y(), sought.turns.z[k] = near[at].z();
        sought.sizes[k] = a[at].norm();
    }
    climb(matrices, sought.sizes, sought.turns, sought.found);
    return sought;
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

void nearest_rotations(std::span<const Mat3d> a, std::span<Quatd> near) {
    require(a.size() == near.size(), "every matrix has a rotation that its own is to be near to");
    for (std::size_t first = 0; first < near.size(); first += lanes) {
        const Sought sought = climbed(a.subspan(first), near.subspan(first));
        for (std::size_t k = 0; k < std::min(lanes, near.size() - first); ++k) {
            Quatd& one = near[first + k];
            if (!(sought.sizes[k] > 0 && std::isfinite(sought.sizes[k]))) continue; // says nothing of a turn
            if (sought.found[k]) {
                sought.take(k, one);
                continue;
            }
            one = search(a[first + k], sought.sizes[k], one);
            // What was preferred moved it a little from where A says.
            const Sought closer = climbed(a.subspan(first + k, 1), {&one, 1});
            if (closer.found[0]) closer.take(0, one);
        }
    }
}

Quatd nearest_rotation(const Mat3d& a, const Quatd& near) {
    Quatd one = near;
    nearest_rotations({&a, 1}, {&one, 1});
    return one;
}

} // namespace knead

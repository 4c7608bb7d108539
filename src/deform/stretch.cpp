#include "deform/stretch.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

// A spread of so much of the largest one begins to count, and counts in full: a noisy or curved surface stays
// below, the outermost layer of a solid above.
constexpr double begins_to_count = 0.03;
constexpr double counts_in_full = 0.12;

constexpr double largest_strain = 2;      // of Hencky
constexpr double most_answered = 5.0 / 3; // of a strain, by its target: more would overshoot

double how_much_counts(double ratio) {
    const double t = std::clamp((ratio - begins_to_count) / (counts_in_full - begins_to_count), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// f of the eigenvalues of a symmetric matrix.
template<typename Function>
Mat3d of_eigenvalues(const Mat3d& symmetric, Function&& f) {
    Eigen::SelfAdjointEigenSolver<Mat3d> solver;
    solver.computeDirect(symmetric);
    const Vec3d values = solver.eigenvalues().unaryExpr(f);
    return solver.eigenvectors() * values.asDiagonal() * solver.eigenvectors().transpose();
}

// FᵀF - I.
Mat3d beyond_rigid(const Mat3d& gradient) {
    return gradient + gradient.transpose() + gradient.transpose() * gradient;
}

} // namespace

Surroundings surroundings_of(const Mat3d& spread) {
    Surroundings result;
    Eigen::SelfAdjointEigenSolver<Mat3d> solver;
    solver.computeDirect(spread);
    const Vec3d& values = solver.eigenvalues();
    if (!(values[2] > 0)) return result;
    for (int k = 0; k < 3; ++k) {
        const double counts = how_much_counts(values[k] / values[2]);
        const Vec3d axis = solver.eigenvectors().col(k);
        const Mat3d square = axis * axis.transpose(); // times counts afterwards: (c a) aᵀ is not symmetric
        if (counts > 0) result.inverse += (counts / values[k]) * square;
        result.open -= counts * square;
        if (k == 0) result.thickness = counts;
    }
    return result;
}

Mat3d gradient_of(const Surroundings& surroundings, const Mat3d& displaced, const Mat3d& turn) {
    return displaced * surroundings.inverse + turn * surroundings.open;
}

Mat3d elastic_target(const Surroundings& surroundings, const Mat3d& gradient, double poisson) {
    if (poisson == 0) return Mat3d::Zero();
    const Mat3d beyond = beyond_rigid(gradient);
    if (beyond.isZero(0)) return Mat3d::Zero();
    const Mat3d strain = of_eigenvalues(beyond, [](double value) {
        return std::clamp(0.5 * std::log1p(std::max(value, -1 + 1e-9)), -largest_strain, largest_strain);
    });
    const double thickness = surroundings.thickness;
    const double ratio = (1 - thickness) * poisson + thickness * poisson / (1 - poisson);
    // M's eigenvalues; on a surface and in a solid it has no others.
    const double of_shape = 1 - ratio, of_size = 1 + (1 + thickness) * ratio;
    const double loose = surroundings.looseness, stiffest = std::max(of_shape, of_size);
    const double scale = std::min(1 / (1 + loose), most_answered / (stiffest * (1 + loose * most_answered)));
    const auto answer = [&](double stiffness) { return scale * stiffness / (1 - scale * loose * stiffness); };
    const double shape = answer(of_shape), size = answer(of_size);
    const Mat3d answered = shape * strain + (size - shape) / (2 + thickness) * strain.trace() *
                                                (Mat3d::Identity() - surroundings.open);
    return of_eigenvalues(strain - answered, [](double value) { return std::expm1(value); });
}

} // namespace knead

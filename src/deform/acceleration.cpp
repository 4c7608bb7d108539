#include "deform/acceleration.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <span>

namespace knead {

namespace {

// Of the diagonal: steps that say the same must not be played off against each other.
constexpr double regularization = 1e-10;

constexpr double too_much_worse = 4; // of the squared residual

// Those who remember no more than so much step no farther than so many times their residual.
constexpr std::size_t knows_little = 2;
constexpr double careful_step = 1.5;

using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, Acceleration::most_remembered,
                            Acceleration::most_remembered>;
using SmallVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, Acceleration::most_remembered, 1>;
using Vector = Eigen::Map<const Eigen::VectorXd>;

Vector as_vector(std::span<const double> values) {
    return {values.data(), static_cast<Eigen::Index>(values.size())};
}

// Of how many samples the rotations count.
std::size_t turning_rows(const SampleSystem& system) {
    return system.midway > 0 ? system.free_sample.size() : 0;
}

// u: displacements, then rotations.
void read_state(const SampleSystem& system, const SampleState& state, std::vector<double>& into) {
    const std::size_t displacements = 3 * system.moving_rows, turning = turning_rows(system);
    into.resize(displacements + 4 * turning);
    for (std::size_t row = 0; row < system.moving_rows; ++row)
        Eigen::Map<Vec3d>(into.data() + 3 * row) = state.displacement[system.free_sample[row]];
    const double length = system.mean_length;
    for (std::size_t row = 0; row < turning; ++row)
        Eigen::Map<Eigen::Vector4d>(into.data() + displacements + 4 * row) =
            length * state.rotation[system.free_sample[row]].coeffs();
}

// The other way, of G(u) less a share of a step.
void write_state(const SampleSystem& system, const std::vector<double>& result, double share,
                 const std::vector<double>& step, SampleState& state) {
    const std::size_t displacements = 3 * system.moving_rows;
    for (std::size_t row = 0; row < system.moving_rows; ++row)
        state.displacement[system.free_sample[row]] = Eigen::Map<const Vec3d>(result.data() + 3 * row) -
                                                      share * Eigen::Map<const Vec3d>(step.data() + 3 * row);
    const double shortest = 1e-6 * system.mean_length;
    for (std::size_t row = 0; row < turning_rows(system); ++row) {
        const std::size_t at = displacements + 4 * row;
        const Eigen::Vector4d turn = Eigen::Map<const Eigen::Vector4d>(result.data() + at) -
                                     share * Eigen::Map<const Eigen::Vector4d>(step.data() + at);
        if (turn.norm() > shortest) state.rotation[system.free_sample[row]].coeffs() = turn.normalized();
    }
}

std::span<const double> column(const std::vector<double>& columns, std::size_t which, std::size_t size) {
    return std::span(columns).subspan(which * size, size);
}

// The last iteration's differences in the place of the oldest.
void remember(Acceleration& memory, std::span<const double> result, std::span<const double> residual) {
    const std::size_t size = result.size();
    memory.result_steps.resize(Acceleration::most_remembered * size);
    memory.residual_steps.resize(Acceleration::most_remembered * size);
    for (std::size_t i = 0; i < size; ++i) {
        memory.result_steps[memory.next * size + i] = result[i] - memory.result[i];
        memory.residual_steps[memory.next * size + i] = residual[i] - memory.residual[i];
    }
    memory.next = (memory.next + 1) % Acceleration::most_remembered;
    memory.remembered = std::min(memory.remembered + 1, Acceleration::most_remembered);
}

// θ.
SmallVector best_combination(const Acceleration& memory, std::span<const double> residual) {
    const std::size_t size = residual.size();
    const auto count = static_cast<Eigen::Index>(memory.remembered);
    Small products = Small::Zero(count, count);
    SmallVector side = SmallVector::Zero(count);
    for (Eigen::Index a = 0; a < count; ++a) {
        const Vector step = as_vector(column(memory.residual_steps, static_cast<std::size_t>(a), size));
        for (Eigen::Index b = 0; b <= a; ++b)
            products(a, b) = products(b, a) =
                step.dot(as_vector(column(memory.residual_steps, static_cast<std::size_t>(b), size)));
        side[a] = step.dot(as_vector(residual));
    }
    const double trace = products.trace();
    products.diagonal().array() += regularization * trace;
    if (!(trace > 0)) return SmallVector::Zero(count);
    return products.ldlt().solve(side);
}

} // namespace

void forget(Acceleration& memory) {
    memory.remembered = memory.next = 0;
    memory.result.clear();
    memory.residual.clear();
    memory.alone = false;
    memory.last_way = 0;
    memory.stalled = 0;
}

double iterate(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
               Acceleration& memory, Workers& workers) {
    std::vector<double>& residual = memory.before;
    read_state(system, state, memory.before);
    const double way = iterate(system, handles, state, workers);
    read_state(system, state, memory.now);
    for (std::size_t i = 0; i < residual.size(); ++i) residual[i] = memory.now[i] - residual[i];

    const bool is_first = memory.result.empty();
    if (!is_first) {
        const double before = as_vector(memory.residual).squaredNorm();
        if (as_vector(residual).squaredNorm() > too_much_worse * before)
            memory.remembered = memory.next = 0;
        else
            remember(memory, memory.now, residual);
    }
    std::swap(memory.result, memory.now);
    std::swap(memory.residual, memory.before);
    if (memory.remembered == 0) return way;

    const SmallVector combination = best_combination(memory, memory.residual);
    const std::size_t size = memory.result.size();
    Eigen::Map<Eigen::VectorXd> step(memory.now.data(), static_cast<Eigen::Index>(size)); // ΔG θ
    step.setZero();
    for (std::size_t k = 0; k < memory.remembered; ++k)
        step += combination[static_cast<Eigen::Index>(k)] * as_vector(column(memory.result_steps, k, size));
    const double longest = careful_step * as_vector(memory.residual).norm();
    const double share =
        memory.remembered <= knows_little && step.norm() > longest ? longest / step.norm() : 1;
    write_state(system, memory.result, share, memory.now, state);
    return way;
}

} // namespace knead

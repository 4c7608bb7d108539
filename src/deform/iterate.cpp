// The per-frame half of sample_system.h.

#include "deform/rotation.h"
#include "deform/sample_system.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t grain = 256;

// Equations (3): the samples of handles go where the handles are.
void place_handles(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state) {
    for (std::size_t s = 0; s < system.rest.handle.size(); ++s) {
        if (system.rest.handle[s] == no_index) continue;
        const HandleMotion& motion = handles[system.rest.handle[s]];
        const Mat3d beyond_identity = motion.linear - Mat3d::Identity();
        state.rotation[s] = motion.rotation;
        state.displacement[s] = beyond_identity * system.rest.position[s] + motion.offset;
        system.turn[s] = beyond_identity;
    }
}

// The first columns of the right-hand side for rotations: `own(row)` of the sample itself, and what the
// handles around it give, times `smoothing`.
template<typename Own>
void assemble_rotations(SampleSystem& system, const SampleState& state, double smoothing, Own&& own,
                        Workers& workers) {
    const SampleRest& rest = system.rest;
    const std::size_t rows = system.free_sample.size();
    workers.for_each(rows, grain, [&](std::size_t row) {
        const Index i = system.free_sample[row];
        Eigen::Vector4d side = own(row);
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            const Index j = rest.graph.neighbor[link];
            if (system.unknown[j] != no_index) continue;
            const Quatd& given = state.rotation[j];
            side += smoothing * rest.weight[link] *
                    Eigen::Vector4d(given.w() - 1, given.x(), given.y(), given.z());
        }
        for (std::size_t c = 0; c < 4; ++c) system.columns[c * rows + row] = side[static_cast<int>(c)];
    });
}

// The solved rotations, normalised; one that vanished stays what it was.
void take_rotations(SampleSystem& system, SampleState& state, Workers& workers) {
    const std::size_t rows = system.free_sample.size();
    workers.for_each(rows, grain, [&](std::size_t row) {
        const double* column = system.columns.data() + row;
        const Quatd solved(1 + column[0], column[rows], column[2 * rows], column[3 * rows]);
        const double length = solved.norm();
        const Index i = system.free_sample[row];
        if (length > 1e-6) state.rotation[i].coeffs() = solved.coeffs() / length;
        system.turn[i] = turn_of(state.rotation[i]);
    });
}

// Step 1: the rotation that the sample's edges made.
Quatd local_rotation(const SampleRest& rest, const SampleState& state, Index i) {
    Mat3d spread = Mat3d::Zero();
    for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
        const Index j = rest.graph.neighbor[link];
        const Vec3d edge = rest.position[j] - rest.position[i];
        const Vec3d now = edge + (state.displacement[j] - state.displacement[i]);
        spread.noalias() += (rest.weight[link] * now) * edge.transpose();
    }
    return nearest_rotation(spread, state.rotation[i]);
}

// Step 3. Returns the longest way that a sample went.
double solve_positions(SampleSystem& system, SampleState& state, Workers& workers) {
    const SampleRest& rest = system.rest;
    const std::size_t rows = system.free_sample.size();
    workers.for_each(rows, grain, [&](std::size_t row) {
        const Index i = system.free_sample[row];
        Vec3d side = Vec3d::Zero();
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            const Index j = rest.graph.neighbor[link];
            const Vec3d back = rest.position[i] - rest.position[j];
            Vec3d part = 0.5 * (system.turn[i] * back + system.turn[j] * back);
            if (system.unknown[j] == no_index) part += state.displacement[j];
            side += rest.weight[link] * part;
        }
        for (std::size_t c = 0; c < 3; ++c) system.columns[c * rows + row] = side[static_cast<int>(c)];
    });
    system.positions.solve({system.columns.data(), 3 * rows}, 3);

    double longest = 0;
    for (std::size_t row = 0; row < rows; ++row) {
        const double* column = system.columns.data() + row;
        const Vec3d solved(column[0], column[rows], column[2 * rows]);
        Vec3d& displacement = state.displacement[system.free_sample[row]];
        longest = std::max(longest, (solved - displacement).squaredNorm());
        displacement = solved;
    }
    return std::sqrt(longest);
}

} // namespace

void start_edit(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
                Workers& workers) {
    place_handles(system, handles, state);
    assemble_rotations(
        system, state, 1.0, [](std::size_t) -> Eigen::Vector4d { return Eigen::Vector4d::Zero(); }, workers);
    system.positions.solve(system.columns, 4);
    take_rotations(system, state, workers);
    solve_positions(system, state, workers);
}

double iterate(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
               Workers& workers) {
    place_handles(system, handles, state);
    assemble_rotations(
        system, state, system.smoothing,
        [&](std::size_t row) -> Eigen::Vector4d {
            const Quatd local = local_rotation(system.rest, state, system.free_sample[row]);
            return system.confidence[row] * Eigen::Vector4d(local.w() - 1, local.x(), local.y(), local.z());
        },
        workers);
    system.rotations.solve(system.columns, 4);
    take_rotations(system, state, workers);
    return solve_positions(system, state, workers);
}

} // namespace knead

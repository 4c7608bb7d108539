#include "deform/sample_system.h"

#include "base/require.h"
#include "graph/neighbors.h"

#include <array>

namespace knead {

namespace {

// Which samples hang together with no handle.
std::vector<bool> find_left_out(const SampleRest& rest) {
    const Components components = find_components(rest.graph);
    std::vector<bool> held(components.size.size(), false);
    for (std::size_t s = 0; s < rest.handle.size(); ++s)
        if (rest.handle[s] != no_index) held[components.component[s]] = true;
    std::vector<bool> left_out(rest.handle.size());
    for (std::size_t s = 0; s < rest.handle.size(); ++s) left_out[s] = !held[components.component[s]];
    return left_out;
}

void number_unknowns(SampleSystem& system) {
    system.unknown.assign(system.rest.handle.size(), no_index);
    system.free_sample.clear();
    for (Index s = 0; s < system.rest.handle.size(); ++s) {
        if (system.rest.handle[s] != no_index || system.left_out[s]) continue;
        system.unknown[s] = static_cast<Index>(system.free_sample.size());
        system.free_sample.push_back(s);
    }
}

// ℓ²: the mean square length of the links at the unknown samples.
double mean_square_length(const SampleSystem& system) {
    double sum = 0;
    std::size_t links = 0;
    for (const Index i : system.free_sample) {
        for (const Index j : system.rest.graph.row(i)) {
            sum += (system.rest.position[j] - system.rest.position[i]).squaredNorm();
            ++links;
        }
    }
    return links > 0 && sum > 0 ? sum / static_cast<double>(links) : 1.0;
}

// L over the unknown samples. Samples are numbered in ascending order, so rows ascend within a column.
SparseMatrix laplacian(const SampleSystem& system) {
    const SampleRest& rest = system.rest;
    SparseMatrix matrix;
    matrix.first.push_back(0);
    for (Index row = 0; row < system.free_sample.size(); ++row) {
        const Index i = system.free_sample[row];
        double diagonal = 0;
        std::size_t diagonal_at = no_index;
        const auto put_diagonal = [&] {
            diagonal_at = matrix.value.size();
            matrix.row.push_back(static_cast<int>(row));
            matrix.value.push_back(0);
        };
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            const Index j = rest.graph.neighbor[link];
            diagonal += rest.weight[link];
            if (j > i && diagonal_at == no_index) put_diagonal();
            if (system.unknown[j] == no_index) continue;
            matrix.row.push_back(static_cast<int>(system.unknown[j]));
            matrix.value.push_back(-rest.weight[link]);
        }
        if (diagonal_at == no_index) put_diagonal();
        matrix.value[diagonal_at] = diagonal;
        matrix.first.push_back(static_cast<int>(matrix.row.size()));
    }
    return matrix;
}

// β/ℓ² L + C, of the pattern of L.
SparseMatrix rotation_matrix(const SampleSystem& system, const SparseMatrix& laplacian) {
    SparseMatrix matrix = laplacian;
    for (std::size_t column = 0; column < system.free_sample.size(); ++column) {
        for (int at = matrix.first[column]; at < matrix.first[column + 1]; ++at) {
            double& value = matrix.value[static_cast<std::size_t>(at)];
            value *= system.smoothing;
            if (matrix.row[static_cast<std::size_t>(at)] == static_cast<int>(column))
                value += system.confidence[column];
        }
    }
    return matrix;
}

void find_confidence(SampleSystem& system, double square_length) {
    const SampleRest& rest = system.rest;
    system.confidence.assign(system.free_sample.size(), 0);
    for (std::size_t row = 0; row < system.free_sample.size(); ++row) {
        const Index i = system.free_sample[row];
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link)
            system.confidence[row] +=
                rest.weight[link] *
                (rest.position[rest.graph.neighbor[link]] - rest.position[i]).squaredNorm() / square_length;
    }
}

void find_surroundings(SampleSystem& system, Workers& workers) {
    const SampleRest& rest = system.rest;
    system.surroundings.resize(system.free_sample.size());
    workers.for_each(system.free_sample.size(), 256, [&](std::size_t row) {
        const Index i = system.free_sample[row];
        Mat3d spread = Mat3d::Zero();
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            const Vec3d edge = rest.position[rest.graph.neighbor[link]] - rest.position[i];
            spread += rest.weight[link] * edge * edge.transpose();
        }
        system.surroundings[row] = surroundings_of(spread);
    });
}

} // namespace

FactorOutcome build_system(SampleRest rest, SampleSystem& system, Workers& workers) {
    require(rest.weight.size() == rest.graph.neighbor.size(), "a weight a link");
    require(rest.position.size() == rest.graph.size() && rest.handle.size() == rest.graph.size(),
            "an entry a sample");
    system.rest = std::move(rest);
    system.left_out = find_left_out(system.rest);
    number_unknowns(system);
    const double square_length = mean_square_length(system);
    system.smoothing =
        system.rest.stiffness * system.rest.cloud_size * system.rest.cloud_size / square_length;
    find_confidence(system, square_length);
    find_surroundings(system, workers);
    set_poisson(system, system.rest.poisson);
    system.turn.assign(system.rest.handle.size(), Mat3d::Zero());
    system.columns.assign(4 * system.free_sample.size(), 0);

    const SparseMatrix matrix = laplacian(system);
    const std::vector<int> order = minimum_degree_order(matrix);
    const SparseMatrix smoothing = rotation_matrix(system, matrix);
    // Neither knows of the other; SuperLU keeps no state between its calls.
    std::array<FactorOutcome, 2> outcomes;
    workers.for_each(2, 1, [&](std::size_t which) {
        outcomes[which] = which == 0 ? system.positions.factorize(matrix, order)
                                     : system.rotations.factorize(smoothing, order);
    });
    return outcomes[0].solved ? outcomes[1] : outcomes[0];
}

void set_poisson(SampleSystem& system, double poisson) {
    require(poisson > -1 && poisson < 0.5, "Poisson's ratio of a stable material");
    system.rest.poisson = poisson;
    system.target.assign(poisson == 0 ? 0 : system.free_sample.size(), Mat3d::Zero());
}

SampleState rest_state(const SampleSystem& system) {
    SampleState state;
    state.rotation.assign(system.rest.handle.size(), Quatd::Identity());
    state.displacement.assign(system.rest.handle.size(), Vec3d::Zero());
    return state;
}

} // namespace knead

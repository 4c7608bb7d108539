#include "deform/sample_system.h"

#include "base/require.h"
#include "deform/looseness.h"
#include "graph/neighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace knead {

namespace {

// The stiffness for which γ is one half.
constexpr double next_to_nothing = 1e-4;

// With an energy of points, links have so much of their weight.
constexpr double share_of_links = 0.01;

// Turns that spread less far than so many ℓ², β/ℓ², are left to links; from the second on to points.
constexpr double least_smoothing = 0.15, enough_smoothing = 0.3;

// Of the weight of a leaf's link that is no longer than others.
constexpr double leaf_share = 1e-3;

// Which samples hang together with no handle.
std::vector<bool> find_left_out(const SampleRest& rest, Workers& workers) {
    const Components components = find_components(rest.graph, workers);
    std::vector<bool> held(components.size.size(), false);
    for (std::size_t s = 0; s < rest.handle.size(); ++s)
        if (rest.handle[s] != no_index) held[components.component[s]] = true;
    std::vector<bool> left_out(rest.handle.size());
    for (std::size_t s = 0; s < rest.handle.size(); ++s) left_out[s] = !held[components.component[s]];
    return left_out;
}

void number_unknowns(SampleSystem& system) {
    const std::vector<Index>& handle = system.rest.handle;
    system.unknown.assign(handle.size(), no_index);
    system.free_sample.clear();
    const auto number = [&](Index s) {
        system.unknown[s] = static_cast<Index>(system.free_sample.size());
        system.free_sample.push_back(s);
    };
    for (Index s = 0; s < handle.size(); ++s)
        if (handle[s] == no_index && !system.left_out[s]) number(s);
    system.moving_rows = system.free_sample.size();
    for (Index s = 0; s < handle.size(); ++s)
        if (is_set(system.rest.turns_freely, handle[s]) &&
            !system.rest.graph.row(s).empty()) // one without links has nothing to turn it
            number(s);
}

// ℓ², the mean square length of the links at the unknown samples: of those that are no leaves' links, if
// there are any.
double mean_square_length(const SampleSystem& system) {
    const SampleRest& rest = system.rest;
    double sum = 0, sum_of_leaves = 0;
    std::size_t links = 0, links_of_leaves = 0;
    for (const Index i : system.free_sample)
        for (const Index j : rest.graph.row(i)) {
            const bool at_leaf = is_leaf(rest, i) || is_leaf(rest, j);
            (at_leaf ? sum_of_leaves : sum) += (rest.position[j] - rest.position[i]).squaredNorm();
            ++(at_leaf ? links_of_leaves : links);
        }
    if (links > 0 && sum > 0) return sum / static_cast<double>(links);
    return sum_of_leaves > 0 ? sum_of_leaves / static_cast<double>(links_of_leaves) : 1.0;
}

// Of a long one's link the less: its length counts squared in what surrounds the other end.
void lighten_leaves(SampleRest& rest, double square_length) {
    for (Index i = 0; i < rest.graph.size(); ++i) {
        if (!is_leaf(rest, i)) continue;
        const Index other = rest.graph.row(i).front();
        const double square = (rest.position[other] - rest.position[i]).squaredNorm();
        const double share = square > square_length ? leaf_share * square_length / square : leaf_share;
        rest.weight[rest.graph.first[i]] *= share;
        rest.weight[find_link(rest.graph, other, i).value()] *= share;
    }
}

// Sums up what stands in a column more than once.
void merge(std::vector<std::pair<int, double>>& column) {
    std::ranges::sort(column);
    std::size_t kept = 0;
    for (std::size_t at = 0; at < column.size(); ++at) {
        if (kept > 0 && column[kept - 1].first == column[at].first)
            column[kept - 1].second += column[at].second;
        else
            column[kept++] = column[at];
    }
    column.resize(kept);
}

// L of the first rows, so many: for ways or for turns; null: of links alone.
SparseMatrix laplacian(const SampleSystem& system, std::size_t rows, double BodyPair::*of) {
    const SampleRest& rest = system.rest;
    SparseMatrix matrix;
    matrix.first.reserve(rows + 1);
    matrix.row.reserve(rest.graph.neighbor.size() + rows);
    matrix.value.reserve(rest.graph.neighbor.size() + rows);
    matrix.first.push_back(0);
    std::vector<std::pair<int, double>> column;
    for (Index row = 0; row < rows; ++row) {
        const Index i = system.free_sample[row];
        double diagonal = 0;
        column.clear();
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
            diagonal += rest.weight[link];
            const Index other = system.unknown[rest.graph.neighbor[link]];
            if (other < rows) column.emplace_back(static_cast<int>(other), -rest.weight[link]);
        }
        column.emplace_back(static_cast<int>(row), diagonal);
        const PointEnergy& energy = rest.energy;
        if (of && !energy.first.empty())
            for (Index at = energy.first[i]; at < energy.first[i + 1]; ++at)
                if (const Index s = energy.body[at]; s < energy.samples && system.unknown[s] < rows)
                    column.emplace_back(static_cast<int>(system.unknown[s]), energy.pair[at].*of);
        merge(column);
        for (const auto& [at, value] : column) {
            matrix.row.push_back(at);
            matrix.value.push_back(value);
        }
        require(matrix.row.size() <= std::numeric_limits<int>::max(), "a matrix is counted by int");
        matrix.first.push_back(static_cast<int>(matrix.row.size()));
    }
    return matrix;
}

// Whether the largest of the matrices can be ordered. All links are counted only where that decides it: what
// handles hold needs none.
FactorOutcome all_can_be_ordered(const SampleSystem& system) {
    const SampleRest& rest = system.rest;
    const std::size_t rows = system.free_sample.size();
    const FactorOutcome at_most =
        can_be_ordered(rows, rows + rest.graph.neighbor.size() + rest.energy.pair.size());
    if (at_most.solved) return at_most;
    std::size_t entries = rows;
    for (const Index i : system.free_sample) {
        const auto is_unknown = [&](Index other) { return system.unknown[other] != no_index; };
        entries += static_cast<std::size_t>(std::ranges::count_if(rest.graph.row(i), is_unknown));
        if (!rest.energy.first.empty()) entries += rest.energy.first[i + 1] - rest.energy.first[i];
    }
    return can_be_ordered(rows, entries);
}

// Calls change(value, row) for every diagonal entry.
template<typename Change>
void for_diagonal(SparseMatrix& matrix, Change&& change) {
    for (std::size_t column = 0; column + 1 < matrix.first.size(); ++column)
        for (int at = matrix.first[column]; at < matrix.first[column + 1]; ++at)
            if (matrix.row[static_cast<std::size_t>(at)] == static_cast<int>(column))
                change(matrix.value[static_cast<std::size_t>(at)], column);
}

// L + μ.
SparseMatrix pulled_matrix(const SparseMatrix& laplacian, const std::vector<double>& pull) {
    SparseMatrix matrix = laplacian;
    if (!pull.empty()) for_diagonal(matrix, [&](double& value, std::size_t row) { value += pull[row]; });
    return matrix;
}

// β/ℓ² (L + μ) + C, of the pattern of L.
SparseMatrix rotation_matrix(const SampleSystem& system, const SparseMatrix& laplacian) {
    SparseMatrix matrix = pulled_matrix(laplacian, system.turn_pull);
    for (double& value : matrix.value) value *= system.smoothing;
    for_diagonal(matrix, [&](double& value, std::size_t row) { value += system.confidence[row]; });
    return matrix;
}

SparseMatrix position_matrix(const SampleSystem& system, const SparseMatrix& laplacian) {
    return pulled_matrix(laplacian, system.pull);
}

// L + μ, with so little more on the diagonal that increments are as good as harmonic, but vanish where no
// handle gives any.
SparseMatrix increment_matrix(const SampleSystem& system, const SparseMatrix& laplacian) {
    SparseMatrix matrix = pulled_matrix(laplacian, system.turn_pull);
    for_diagonal(matrix, [](double& value, std::size_t /*row*/) { value *= 1 + 1e-9; });
    return matrix;
}

void find_samples_of_handles(SampleSystem& system) {
    system.sample_of_handle.clear();
    for (Index s = 0; s < system.rest.handle.size(); ++s) {
        const Index handle = system.rest.handle[s];
        if (handle == no_index || system.unknown[s] != no_index) continue;
        if (handle >= system.sample_of_handle.size()) system.sample_of_handle.resize(handle + 1, no_index);
        system.sample_of_handle[handle] = s;
    }
}

void find_pull(SampleSystem& system) {
    const std::size_t rows = system.rest.pulled.empty() ? 0 : system.free_sample.size();
    system.pull.assign(rows, 0);
    system.turn_pull.assign(rows, 0);
    for (const SoftHold& hold : system.rest.pulled) {
        const Index row = system.unknown[hold.sample];
        require(row < system.moving_rows && hold.weight > 0, "only free samples of held parts are pulled");
        system.pull[row] += hold.weight;
        if (turns_with(system, hold) != no_index) system.turn_pull[row] += hold.weight;
    }
}

void find_beds(SampleSystem& system, double square_length) {
    system.beds.clear();
    system.bed_parts.clear();
    system.bed_part.assign(system.rest.pulled.size(), no_index);
    std::map<std::pair<Index, Index>, Index> part_of; // bed, turner
    for (std::size_t k = 0; k < system.rest.pulled.size(); ++k) {
        const SoftHold& hold = system.rest.pulled[k];
        if (hold.bed == no_index) continue;
        if (hold.bed >= system.beds.size()) system.beds.resize(hold.bed + std::size_t{1});
        system.beds[hold.bed].spread +=
            hold.weight * (system.rest.position[hold.sample] - hold.anchor).squaredNorm();
        const auto [known, is_new] =
            part_of.try_emplace({hold.bed, hold.turner}, static_cast<Index>(system.bed_parts.size()));
        system.bed_part[k] = known->second;
        if (!is_new) continue;
        const Index row = system.unknown[hold.turner];
        require(row != no_index, "what others turn about turns by itself");
        system.bed_parts.push_back(
            {hold.bed, hold.turner, hold.as_turner, system.confidence[row] * square_length});
    }
}

void find_confidence(SampleSystem& system, double square_length) {
    const SampleRest& rest = system.rest;
    system.confidence.assign(system.free_sample.size(), 0);
    for (std::size_t row = 0; row < system.free_sample.size(); ++row) {
        const Index i = system.free_sample[row];
        if (is_leaf(rest, i)) continue;
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link)
            system.confidence[row] +=
                rest.weight[link] *
                (rest.position[rest.graph.neighbor[link]] - rest.position[i]).squaredNorm() / square_length;
    }
}

// The energy of the points takes the place of the links, and weighs as much; or is dropped.
void weigh_energy(SampleSystem& system, double square_length) {
    SampleRest& rest = system.rest;
    PointEnergy& energy = rest.energy;
    double of_links = 0, of_points = 0;
    const double share =
        energy.share *
        std::clamp((system.smoothing - least_smoothing) / (enough_smoothing - least_smoothing), 0.0, 1.0);
    if (!energy.first.empty() && share > 0)
        for (std::size_t row = 0; row < system.free_sample.size(); ++row) {
            of_links += system.confidence[row] * square_length;
            of_points += energy.confidence[system.free_sample[row]];
        }
    if (!(of_points > 0)) {
        energy = {};
        return;
    }
    scale(energy, share * of_links / of_points);
    energy.share = share;
    const double of_them = 1 - share * (1 - share_of_links);
    for (double& weight : rest.weight) weight *= of_them;
    for (std::size_t row = 0; row < system.free_sample.size(); ++row)
        system.confidence[row] =
            of_them * system.confidence[row] + energy.confidence[system.free_sample[row]] / square_length;
}

// The bodies of the energy: which of them are given, and a sample of each handle.
void number_bodies(SampleSystem& system) {
    const PointEnergy& energy = system.rest.energy;
    system.body.assign(energy.bodies, Body{});
    for (Index s = 0; s < energy.samples; ++s) {
        system.body[s].placed = !(system.unknown[s] < system.moving_rows);
        system.body[s].turned = system.unknown[s] == no_index;
        const Index handle = system.rest.handle[s];
        if (handle != no_index && handle < energy.handles()) system.body[energy.samples + handle].from = s;
    }
}

void find_weighted_edges(SampleSystem& system, Workers& workers) {
    const SampleRest& rest = system.rest;
    system.weighted_edge.resize(rest.graph.neighbor.size());
    workers.for_each(rest.graph.size(), 256, [&](std::size_t i) {
        for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link)
            system.weighted_edge[link] =
                rest.weight[link] * (rest.position[rest.graph.neighbor[link]] - rest.position[i]);
    });
}

void find_surroundings(SampleSystem& system, std::size_t row) {
    const SampleRest& rest = system.rest;
    const Index i = system.free_sample[row];
    Mat3d spread = Mat3d::Zero();
    for (Index link = rest.graph.first[i]; link < rest.graph.first[i + 1]; ++link) {
        const Vec3d edge = rest.position[rest.graph.neighbor[link]] - rest.position[i];
        const Mat3d square = edge * edge.transpose(); // times w afterwards: (w e) eᵀ is not symmetric
        spread += rest.weight[link] * square;
    }
    system.spread[row] = spread;
    system.surroundings[row] = surroundings_of(spread);
    if (!system.with_points.empty())
        system.with_points[row] = surroundings_of(spread + rest.energy.spread[i]);
}

// L of the rows that move, and the order to eliminate them in.
struct OrderedLaplacian {
    SparseMatrix matrix;
    std::vector<int> order;
};

// That by one worker, which cannot be shared out, and meanwhile the surroundings of all rows by the others.
OrderedLaplacian order_and_find_surroundings(SampleSystem& system, Workers& workers) {
    constexpr std::size_t rows_a_task = 1024;
    const std::size_t rows = system.free_sample.size();
    system.spread.resize(rows);
    system.surroundings.resize(rows);
    system.with_points.resize(system.rest.energy.first.empty() ? 0 : rows);
    OrderedLaplacian result;
    workers.for_each(1 + (rows + rows_a_task - 1) / rows_a_task, 1, [&](std::size_t task) {
        if (task == 0) {
            result.matrix = laplacian(system, system.moving_rows, &BodyPair::way);
            result.order = minimum_degree_order(result.matrix);
            return;
        }
        for (std::size_t row = (task - 1) * rows_a_task; row < std::min(task * rows_a_task, rows); ++row)
            find_surroundings(system, row);
    });
    return result;
}

// All matrices that are needed; none of them knows of the others.
FactorOutcome factorize(SampleSystem& system, const OrderedLaplacian& of_moving, Workers& workers) {
    const std::size_t rows = system.free_sample.size();
    const bool more = hinges(system);
    system.has_increments = more || system.pull != system.turn_pull;
    const SparseMatrix of_links = more ? laplacian(system, rows, nullptr) : SparseMatrix{};
    const SparseMatrix& of_ways = more ? of_links : of_moving.matrix;
    const bool other_turns = !system.rest.energy.first.empty();
    const SparseMatrix of_turns = other_turns ? laplacian(system, rows, &BodyPair::turn) : of_ways;
    const std::vector<int> order = more ? minimum_degree_order(of_turns) : of_moving.order;
    std::array<FactorOutcome, 3> outcomes;
    workers.for_each(system.has_increments ? 3 : 2, 1, [&](std::size_t which) {
        if (which == 0)
            outcomes[0] =
                system.positions.factorize(position_matrix(system, of_moving.matrix), of_moving.order);
        else if (which == 1)
            outcomes[1] = system.rotations.factorize(rotation_matrix(system, of_turns), order);
        else
            outcomes[2] =
                system.increments.factorize(increment_matrix(system, of_ways),
                                            more && other_turns ? minimum_degree_order(of_links) : order);
    });
    for (std::size_t which = 0; which < (system.has_increments ? 3U : 2U); ++which)
        if (!outcomes[which].solved) return outcomes[which];
    return outcomes[0];
}

} // namespace

bool is_leaf(const SampleRest& rest, Index sample) {
    const auto row = rest.graph.row(sample);
    return rest.handle[sample] == no_index && row.size() == 1 && rest.graph.row(row.front()).size() > 1;
}

FactorOutcome build_system(SampleRest rest, SampleSystem& system, Workers& workers) {
    require(rest.weight.size() == rest.graph.neighbor.size(), "a weight a link");
    require(rest.held_part.empty() || rest.held_part.size() == rest.weight.size(), "a part a link, or none");
    require(rest.energy.first.empty() || rest.energy.samples == rest.graph.size(), "bodies are the samples");
    require(rest.position.size() == rest.graph.size() && rest.handle.size() == rest.graph.size(),
            "an entry a sample");
    system.rest = std::move(rest);
    system.left_out = find_left_out(system.rest, workers);
    number_unknowns(system);
    if (FactorOutcome outcome = all_can_be_ordered(system); !outcome.solved) return outcome;
    const double square_length = mean_square_length(system);
    lighten_leaves(system.rest, square_length);
    system.mean_length = std::sqrt(square_length);
    system.smoothing =
        system.rest.stiffness * system.rest.cloud_size * system.rest.cloud_size / square_length;
    const double softness = next_to_nothing / system.rest.stiffness; // whose square may be infinite
    system.midway = 1 / (1 + softness * softness);
    find_confidence(system, square_length);
    weigh_energy(system, square_length);
    number_bodies(system);
    find_weighted_edges(system, workers);
    const OrderedLaplacian of_moving = order_and_find_surroundings(system, workers);
    prepare_fit(system);
    set_poisson(system, system.rest.poisson, workers);
    system.turn.assign(system.rest.handle.size(), Mat3d::Zero());
    system.free_turn.assign(system.rest.turns_freely.size(), Quatd::Identity());
    Index handles = 0;
    for (const Index handle : system.rest.handle)
        if (handle != no_index) handles = std::max(handles, handle + 1);
    system.growth.assign(system.rest.held_part.empty() ? 0 : handles, Mat3d::Zero());
    system.grows = false;
    system.sides.assign(4 * system.free_sample.size(), 0);

    find_samples_of_handles(system);
    find_pull(system);
    find_beds(system, square_length);
    return factorize(system, of_moving, workers);
}

SystemMatrices system_matrices(const SampleSystem& system) {
    return {rotation_matrix(system, laplacian(system, system.free_sample.size(), &BodyPair::turn)),
            position_matrix(system, laplacian(system, system.moving_rows, &BodyPair::way))};
}

void set_poisson(SampleSystem& system, double poisson, Workers& workers) {
    require(poisson > -1 && poisson < 0.5, "Poisson's ratio of a stable material");
    system.rest.poisson = poisson;
    system.target.assign(poisson == 0 ? 0 : system.free_sample.size(), Mat3d::Zero());
    if (poisson != 0) find_looseness(system, workers);
}

SampleState rest_state(const SampleSystem& system) {
    SampleState state;
    state.rotation.assign(system.rest.handle.size(), Quatd::Identity());
    state.displacement.assign(system.rest.handle.size(), Vec3d::Zero());
    return state;
}

} // namespace knead

#include "deform/coarse_level.h"

#include "base/require.h"
#include "deform/rotation.h"
#include "graph/edge_weights.h"
#include "graph/point_order.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace knead {

namespace {

constexpr std::size_t fewest_samples = 600;
constexpr std::size_t fewest_coarse = 200;
constexpr std::size_t samples_a_coarse = 50;

constexpr int relaxing_rounds = 2;

// The coarse samples iterate until what is left is this small beside what they began with, or so many times.
constexpr double left_over = 0.05;
constexpr int most_iterations = 12;

// So many iterations may go hardly less far than those before them.
constexpr int patience = 4;
constexpr double hardly_less = 0.8;

// The samples and their graph in the order of the Morton curve: floods go through near memory then, which
// samples in their own scrambled order are not.
struct OrderedSamples {
    std::vector<Index> sample; // at each place
    std::vector<Index> place;  // of each sample
    Graph graph;               // of the places
    std::vector<float> positions;
};

OrderedSamples ordered(const Graph& graph, std::span<const Vec3d> position, Workers& workers) {
    std::vector<float> positions;
    positions.reserve(3 * position.size());
    for (const Vec3d& p : position)
        for (int axis = 0; axis < 3; ++axis) positions.push_back(static_cast<float>(p[axis]));
    SilentProgress progress;
    const PointOrder order = order_points(positions, workers, progress);
    OrderedSamples result{order.file_index, std::vector<Index>(order.file_index.size()), {}, {}};
    require(result.sample.size() == position.size(), "samples have a place");
    result.positions.resize(positions.size());
    gather(order, positions, 3, result.positions, workers);
    for (Index at = 0; at < result.sample.size(); ++at) result.place[result.sample[at]] = at;
    result.graph.first.push_back(0);
    result.graph.neighbor.reserve(graph.neighbor.size());
    for (const Index s : result.sample) {
        const auto begin = static_cast<std::ptrdiff_t>(result.graph.neighbor.size());
        for (const Index j : graph.row(s)) result.graph.neighbor.push_back(result.place[j]);
        std::sort(result.graph.neighbor.begin() + begin, result.graph.neighbor.end());
        result.graph.first.push_back(static_cast<Index>(result.graph.neighbor.size()));
    }
    return result;
}

// The samples of each handle that a free one is linked to, in scrambled order.
std::map<Index, std::vector<Index>> border_samples(const Graph& graph, std::span<const Index> handle) {
    std::map<Index, std::vector<Index>> border;
    std::vector<Index> held;
    for (Index s = 0; s < handle.size(); ++s)
        if (handle[s] != no_index) held.push_back(s);
    for (const Index s : shuffled(std::move(held)))
        if (std::ranges::any_of(graph.row(s), [&](Index j) { return handle[j] == no_index; }))
            border[handle[s]].push_back(s);
    return border;
}

// The places of the coarse samples: evenly spread among the free samples, and along the borders of the
// handles as densely as that.
std::vector<Index> choose(const Graph& graph, std::span<const Index> handle, const OrderedSamples& ordered,
                          std::span<const std::uint8_t> lengths, Workers& workers) {
    const std::size_t count = std::max(fewest_coarse, handle.size() / samples_a_coarse);
    std::vector<Index> chosen;
    for (Index s = 0; s < handle.size(); ++s)
        if (handle[s] == no_index) chosen.push_back(s);
    chosen = shuffled(std::move(chosen));
    chosen.resize(std::min(chosen.size(), count));
    for (Index& s : chosen) s = ordered.place[s];
    SilentProgress progress;
    chosen = relaxed(std::move(chosen), ordered.graph, lengths, ordered.positions, relaxing_rounds, workers,
                     progress);
    const double spacing = std::sqrt(static_cast<double>(handle.size()) / static_cast<double>(count));
    for (const auto& [whose, samples] : border_samples(graph, handle)) {
        const auto share = static_cast<std::size_t>(std::ceil(static_cast<double>(samples.size()) / spacing));
        for (std::size_t i = 0; i < share; ++i) chosen.push_back(ordered.place[samples[i]]);
    }
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return shuffled(std::move(chosen));
}

// As points follow samples.
void find_followed(const OrderedSamples& ordered, const InfluenceRows& nearest, CoarseSamples& coarse) {
    coarse.followed.resize(nearest.size());
    coarse.nearest.resize(nearest.size());
    for (Index at = 0; at < nearest.size(); ++at) {
        const Index s = ordered.sample[at];
        coarse.followed[s] = influence_of(nearest, InfluenceWeights::smooth, at);
        coarse.nearest[s] = coarse.followed[s].count > 0 ? coarse.followed[s].motion[0] : no_index;
    }
}

// What pulls at samples pulls at the coarse one nearest to them, altogether as much.
std::vector<SoftHold> pulled_together(const SampleRest& rest, const CoarseSamples& coarse) {
    std::map<std::pair<Index, Index>, SoftHold> holds;
    for (const SoftHold& hold : rest.pulled) {
        const Index nearest = coarse.nearest[hold.sample];
        if (nearest == no_index || rest.handle[coarse.sample[nearest]] != no_index) continue;
        SoftHold& together = holds[{nearest, hold.handle}];
        const bool turns_freely = hold.handle < rest.turns_freely.size() && rest.turns_freely[hold.handle];
        together = {nearest, hold.handle, together.weight + hold.weight,
                    turns_freely ? hold.anchor : rest.position[coarse.sample[nearest]]};
    }
    std::vector<SoftHold> result;
    for (const auto& [whom, hold] : holds) result.push_back(hold);
    return result;
}

SampleRest coarse_rest(const SampleRest& rest, const CoarseSamples& coarse, Workers& workers) {
    SampleRest result;
    for (const Index s : coarse.sample) {
        result.position.push_back(rest.position[s]);
        result.handle.push_back(rest.handle[s]);
    }
    result.graph = coarse.between.graph;
    result.weight = isotropic_weights(result.graph, result.position, coarse.between.contact,
                                      border_of_territories, workers);
    result.turns_freely = rest.turns_freely;
    result.pulled = pulled_together(rest, coarse);
    result.cloud_size = rest.cloud_size;
    result.stiffness = rest.stiffness;
    result.poisson = rest.poisson;
    return result;
}

// I of the displacements.
void inject(const SampleState& state, const CoarseLevel& coarse, std::vector<Vec3d>& displacement) {
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c)
        displacement[c] = state.displacement[coarse.samples.sample[c]];
}

// τ, from I u in `before` and the state after the fine iteration.
void find_shift(CoarseLevel& coarse, std::span<const HandleMotion> handles, const SampleState& state,
                Workers& workers) {
    SampleSystem& system = coarse.system;
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c)
        coarse.state.rotation[c] = state.rotation[coarse.samples.sample[c]];
    coarse.state.displacement = coarse.before;
    system.shift.assign(system.moving_rows, Vec3d::Zero());
    iterate(system, handles, coarse.state, workers);
    inject(state, coarse, coarse.before);
    for (std::size_t row = 0; row < system.moving_rows; ++row) {
        const Index c = system.free_sample[row];
        system.shift[row] = coarse.before[c] - coarse.state.displacement[c];
    }
}

// v, from I G(u) in `before`.
void solve_coarse(CoarseLevel& coarse, std::span<const HandleMotion> handles, const SampleState& state,
                  Workers& workers) {
    coarse.state.displacement = coarse.before;
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c)
        coarse.state.rotation[c] = state.rotation[coarse.samples.sample[c]];
    forget(coarse.acceleration);
    double first = 0;
    for (int iteration = 0; iteration < most_iterations; ++iteration) {
        const double way = iterate(coarse.system, handles, coarse.state, coarse.acceleration, workers);
        if (iteration == 0) {
            coarse.turn = coarse.state.rotation;
            first = way;
        }
        if (!(way > left_over * first)) break;
    }
}

// What takes each coarse sample from I G(u) to v.
void find_motions(CoarseLevel& coarse) {
    for (std::size_t c = 0; c < coarse.samples.sample.size(); ++c) {
        Quatd& turn = coarse.turn[c];
        turn = coarse.state.rotation[c] * coarse.turn[c].conjugate();
        if (turn.w() < 0) turn.coeffs() = -turn.coeffs(); // the short way round: these are blended
        const Vec3d from = coarse.system.rest.position[c] + coarse.before[c];
        const Mat3d beyond = turn_of(turn);
        coarse.motion[c] << beyond, coarse.state.displacement[c] - coarse.before[c] - beyond * from;
    }
}

void follow_coarse(const SampleSystem& fine, const CoarseLevel& coarse, SampleState& state,
                   Workers& workers) {
    workers.for_each(fine.free_sample.size(), 256, [&](std::size_t row) {
        const Index s = fine.free_sample[row];
        Eigen::Matrix<double, 3, 4> motion = Eigen::Matrix<double, 3, 4>::Zero();
        Eigen::Vector4d turn = Eigen::Vector4d::Zero();
        const Influence& followed = coarse.samples.followed[s];
        for (std::size_t k = 0; k < followed.count; ++k) {
            const Index c = followed.motion[k];
            motion += static_cast<double>(followed.weight[k]) * coarse.motion[c];
            turn += static_cast<double>(followed.weight[k]) * coarse.turn[c].coeffs();
        }
        if (!(turn.norm() > 1e-6)) return; // nothing is around it
        const Vec3d at = fine.rest.position[s] + state.displacement[s];
        if (row < fine.moving_rows) state.displacement[s] += motion.leftCols<3>() * at + motion.col(3);
        state.rotation[s] = (Quatd(turn) * state.rotation[s]).normalized();
    });
}

} // namespace

bool wants_coarse_level(std::size_t samples) {
    return samples >= fewest_samples;
}

CoarseSamples coarse_samples(const Graph& graph, std::span<const Vec3d> position,
                             std::span<const Index> handle, Workers& workers) {
    const OrderedSamples places = ordered(graph, position, workers);
    const std::vector<std::uint8_t> lengths = link_lengths(places.graph, places.positions, workers);
    const std::vector<Index> chosen = choose(graph, handle, places, lengths, workers);
    CoarseSamples result;
    for (const Index at : chosen) result.sample.push_back(places.sample[at]);
    SilentProgress progress;
    const InfluenceRows nearest = flood(places.graph, lengths, chosen, workers, progress);
    find_followed(places, nearest, result);
    result.between = sample_graph(nearest, chosen, places.graph, workers);
    return result;
}

FactorOutcome build_coarse_level(const SampleSystem& fine, CoarseLevel& coarse, Workers& workers) {
    FactorOutcome outcome =
        build_system(coarse_rest(fine.rest, coarse.samples, workers), coarse.system, workers);
    coarse.state = rest_state(coarse.system);
    coarse.before.assign(coarse.samples.sample.size(), Vec3d::Zero());
    coarse.motion.resize(coarse.samples.sample.size());
    return outcome;
}

double iterate(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
               SampleState& state, Acceleration& memory, Workers& workers) {
    if (memory.alone) return iterate(fine, handles, state, memory, workers);
    inject(state, coarse, coarse.before);
    const double way = iterate(fine, handles, state, workers);
    if (memory.last_way > 0 && way > memory.last_way) {
        state = memory.uncorrected;
        memory.alone = true;
        return way;
    }
    if (memory.last_way > 0 && way > hardly_less * memory.last_way && ++memory.stalled == patience)
        memory.alone = true; // from the next one on
    memory.last_way = way;
    memory.uncorrected = state;
    find_shift(coarse, handles, state, workers);
    solve_coarse(coarse, handles, state, workers);
    find_motions(coarse);
    follow_coarse(fine, coarse, state, workers);
    return way;
}

} // namespace knead

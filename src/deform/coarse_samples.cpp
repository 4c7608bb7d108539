#include "deform/coarse_samples.h"

#include "base/progress.h"
#include "base/require.h"
#include "graph/flood.h"
#include "graph/link_lengths.h"
#include "graph/neighbors.h"
#include "graph/point_order.h"
#include "graph/relaxing.h"
#include "graph/scrambled.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace knead {

namespace {

constexpr std::size_t fewest_samples = 600;
constexpr std::size_t fewest_coarse = 200;
constexpr std::size_t samples_a_coarse = 50;

constexpr int relaxing_rounds = 2;

constexpr std::size_t grain = 256;

// The samples and their graph in the order of the Morton curve: floods go through near memory then, which
// samples in their own order, shuffled in runs, are not.
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
    std::vector<Index>& first = result.graph.first;
    first.push_back(0);
    for (const Index s : result.sample)
        first.push_back(first.back() + static_cast<Index>(graph.row(s).size()));
    result.graph.neighbor.resize(graph.neighbor.size());
    workers.for_each(result.sample.size(), grain, [&](std::size_t at) {
        const std::span<Index> row =
            std::span(result.graph.neighbor).subspan(first[at], first[at + 1] - first[at]);
        std::ranges::transform(graph.row(result.sample[at]), row.begin(),
                               [&](Index j) { return result.place[j]; });
        std::ranges::sort(row);
    });
    return result;
}

// The samples of each of these that a free one is linked to, in scrambled order.
std::map<HeldPart, std::vector<Index>> border_samples(const Graph& graph, std::span<const Index> handle,
                                                      Workers& workers) {
    const Components components = find_components(graph, workers);
    std::map<HeldPart, std::vector<Index>> border;
    std::vector<Index> held;
    for (Index s = 0; s < handle.size(); ++s)
        if (handle[s] != no_index) held.push_back(s);
    for (const Index s : shuffled(std::move(held)))
        if (std::ranges::any_of(graph.row(s), [&](Index j) { return handle[j] == no_index; }))
            border[{handle[s], components.component[s]}].push_back(s);
    return border;
}

// The places of the coarse samples: as many as there are to be among the free samples, spread evenly (from
// where some may come to lie in a handle), and along the borders of the handles as densely as that. Each part
// that a handle reaches into has one of its: a part without would be held by nobody and stay behind.
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
    chosen = relaxed(std::move(chosen), ordered.graph, lengths, ordered.positions, {}, relaxing_rounds,
                     workers, progress);
    const double spacing = std::sqrt(static_cast<double>(handle.size()) / static_cast<double>(count));
    for (const auto& [whose, samples] : border_samples(graph, handle, workers)) {
        const auto share = static_cast<std::size_t>(std::ceil(static_cast<double>(samples.size()) / spacing));
        for (std::size_t i = 0; i < share; ++i) chosen.push_back(ordered.place[samples[i]]);
    }
    std::ranges::sort(chosen);
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    return shuffled(std::move(chosen));
}

void find_followed(const OrderedSamples& ordered, const InfluenceRows& nearest, CoarseSamples& coarse,
                   Workers& workers) {
    coarse.followed.resize(nearest.size());
    coarse.nearest.resize(nearest.size());
    workers.for_each(nearest.size(), grain, [&](std::size_t at) {
        const Index s = ordered.sample[at];
        coarse.followed[s] = influence_of(nearest[at], no_index, InfluenceWeights::smooth);
        coarse.nearest[s] = coarse.followed[s].count > 0 ? coarse.followed[s].motion[0] : no_index;
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
    find_followed(places, nearest, result, workers);
    result.between = sample_graph(nearest, chosen, places.graph, workers);
    return result;
}

} // namespace knead

#include "graph/outliers.h"

#include "graph/bridges.h"
#include "graph/group_tree.h"
#include "graph/nearest.h"
#include "graph/neighbors.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t grain = 2048;

// Of the nearest neighbours, the one whose distance is the spacing: those before it may be nearly the same
// point, seen twice.
constexpr std::size_t usual_neighbor = 3;

constexpr double mist_reach = 10;          // of its own spacings
constexpr std::size_t smallest_share = 10; // mist is less than a tenth

// The pieces that are left when long links are cut.
Components cut_long_links(const Graph& graph, std::span<const float> positions,
                          std::span<const float> spacing, Workers& workers) {
    std::vector<std::uint8_t> is_short(graph.neighbor.size());
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
            const Index u = graph.neighbor[link];
            const double limit = short_way * static_cast<double>(std::min(spacing[v], spacing[u]));
            is_short[link] = static_cast<double>(distance_between(positions, v, u)) <= limit ? 1 : 0;
        }
    });
    return find_components(rewired(graph, is_short, {}, workers), workers);
}

// Of each vertex, whether it sticks out from the pieces that are larger than crumbs.
std::vector<std::uint8_t> find_sticking_out(std::span<const float> positions, const Spacings& spacings,
                                            const Components& pieces, Workers& workers) {
    const auto is_crumb = [&](std::size_t v) { return pieces.size[pieces.component[v]] < crumb; };
    std::vector<Index> group = pieces.component;
    for (std::size_t v = 0; v < group.size(); ++v)
        if (is_crumb(v)) group[v] = no_index;
    const GroupTree tree = group_tree(positions, group, workers);
    std::vector<std::uint8_t> result(group.size(), 0);
    workers.for_each(group.size(), 256, [&](std::size_t v) {
        if (smallest_share * pieces.size[pieces.component[v]] >= group.size()) return;
        const auto own = static_cast<double>(spacings.own[v]);
        const double reach = is_crumb(v) ? std::numeric_limits<double>::infinity() : mist_reach * own;
        const Neighbor other = nearest_of_others(tree, v, reach);
        if (other.vertex == no_index) return;
        // Of the two spacings the larger: among points in clumps nothing sticks out from a clump.
        const float there = std::max(spacings.own[other.vertex], spacings.around[other.vertex]);
        const double limit = short_way * static_cast<double>(there);
        result[v] = other.distance > limit && (is_crumb(v) || own > limit) ? 1 : 0;
    });
    return result;
}

} // namespace

Spacings find_spacings(const Graph& graph, std::span<const float> positions, Workers& workers) {
    Spacings spacings;
    spacings.own.assign(graph.size(), 0);
    spacings.around.assign(graph.size(), 0);
    std::vector<std::array<Index, Nearest::most>> nearest(graph.size());
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        const Nearest found = find_nearest(graph, positions, v);
        nearest[v].fill(no_index);
        for (std::size_t i = 0; i < found.count; ++i) nearest[v][i] = found.near[i].second;
        if (found.count > 0) spacings.own[v] = found.near[std::min(usual_neighbor, found.count) - 1].first;
    });
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        std::array<float, Nearest::most> own;
        auto end = own.begin();
        for (const Index u : nearest[v])
            if (u != no_index) *end++ = spacings.own[u];
        if (end == own.begin()) return;
        const auto middle = own.begin() + (end - own.begin() - 1) / 2;
        std::nth_element(own.begin(), middle, end);
        spacings.around[v] = *middle;
    });
    return spacings;
}

std::vector<std::uint8_t> find_outliers(const Graph& graph, std::span<const float> positions,
                                        const Spacings& spacings, Workers& workers) {
    const Components pieces = cut_long_links(graph, positions, spacings.around, workers);
    const std::vector<std::uint8_t> sticks_out = find_sticking_out(positions, spacings, pieces, workers);
    std::vector<std::size_t> count(pieces.size.size(), 0);
    for (std::size_t v = 0; v < sticks_out.size(); ++v) count[pieces.component[v]] += sticks_out[v];
    std::vector<std::uint8_t> hanging(graph.size());
    for (std::size_t v = 0; v < hanging.size(); ++v) {
        const Index piece = pieces.component[v];
        hanging[v] = 2 * count[piece] > pieces.size[piece] ? 1 : 0;
    }
    return hanging;
}

} // namespace knead

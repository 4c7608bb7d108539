#include "graph/bridges.h"

#include "graph/group_tree.h"
#include "graph/outliers.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace knead {

namespace {

constexpr std::size_t grain = 256;

using Links = std::vector<std::pair<Index, Index>>;

// Every vertex's component, and no_index where it hangs, as the groups of a search.
std::vector<Index> standing(const Components& components, std::span<const std::uint8_t> hanging) {
    std::vector<Index> group = components.component;
    for (std::size_t v = 0; v < group.size(); ++v)
        if (hanging[v]) group[v] = no_index;
    return group;
}

// Of each link, 1 if neither end hangs.
std::vector<std::uint8_t> between_standing(const Graph& graph, std::span<const std::uint8_t> hanging,
                                           Workers& workers) {
    std::vector<std::uint8_t> result(graph.neighbor.size());
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link)
            result[link] = hanging[v] || hanging[graph.neighbor[link]] ? 0 : 1;
    });
    return result;
}

// Links every vertex to other_end(v), where that is one.
template<typename OtherEnd>
Links links_to(std::size_t vertices, OtherEnd&& other_end, Workers& workers) {
    std::vector<Index> end(vertices, no_index);
    workers.for_each(vertices, grain, [&](std::size_t v) { end[v] = other_end(v); });
    Links links;
    for (Index v = 0; v < vertices; ++v)
        if (end[v] != no_index) links.emplace_back(v, end[v]);
    return links;
}

Links find_bridges(const GroupTree& tree, std::span<const float> spacing, const Components& components,
                   Workers& workers) {
    // The largest component need not ask: the others do.
    const auto largest =
        static_cast<Index>(std::ranges::max_element(components.size) - components.size.begin());
    const auto across = [&](std::size_t v) {
        if (tree.group[v] == no_index || tree.group[v] == largest) return no_index;
        const Neighbor other = nearest_of_others(tree, v, widest_gap * static_cast<double>(spacing[v]));
        if (other.vertex == no_index) return no_index;
        return other.distance <= widest_gap * static_cast<double>(spacing[other.vertex]) ? other.vertex
                                                                                         : no_index;
    };
    return links_to(tree.group.size(), across, workers);
}

Links find_hooks(const GroupTree& tree, Workers& workers) {
    const auto hook = [&](std::size_t v) {
        if (tree.group[v] != no_index) return no_index;
        return nearest_of_others(tree, v, std::numeric_limits<double>::infinity()).vertex;
    };
    return links_to(tree.group.size(), hook, workers);
}

// Outliers that are linked through each other, and the standing vertices that they are linked to, piece after
// piece.
struct Dust {
    std::vector<Index> outliers, beside;
};

// Calls visit(dust) for all of it. `standing`: the components without outliers.
template<typename Visit>
void for_all_dust(const Graph& graph, const Components& standing, std::span<const std::uint8_t> outlier,
                  Visit&& visit) {
    std::vector<std::uint8_t> is_met(graph.size(), 0);
    Dust dust;
    for (Index seed = 0; seed < graph.size(); ++seed) {
        if (!outlier[seed] || is_met[seed]) continue;
        is_met[seed] = 1;
        dust.outliers.assign(1, seed);
        dust.beside.clear();
        for (std::size_t next = 0; next < dust.outliers.size(); ++next)
            for (const Index u : graph.row(dust.outliers[next])) {
                if (!outlier[u])
                    dust.beside.push_back(u);
                else if (!is_met[u])
                    dust.outliers.push_back(u), is_met[u] = 1;
            }
        std::ranges::sort(dust.beside, {}, [&](Index v) { return std::pair(standing.component[v], v); });
        dust.beside.erase(std::ranges::unique(dust.beside).begin(), dust.beside.end());
        visit(dust);
    }
}

// The shortest link between two lists of vertices; of long lists, between some of them.
std::pair<Index, Index> shortest_between(std::span<const Index> some, std::span<const Index> others,
                                         std::span<const float> positions) {
    constexpr std::size_t most_pairs = 1 << 22;
    const std::size_t step = 1 + some.size() * others.size() / most_pairs;
    std::pair<Index, Index> shortest{some.front(), others.front()};
    double squared = std::numeric_limits<double>::infinity();
    for (const Index v : some)
        for (std::size_t i = 0; i < others.size(); i += step) {
            const double next = (point_at(positions, v) - point_at(positions, others[i])).squaredNorm();
            if (next < squared) shortest = {v, others[i]}, squared = next;
        }
    return shortest;
}

// A link from the largest piece beside the dust to each of the others.
void tie_pieces(const Dust& dust, const Components& standing, std::span<const float> positions,
                Links& links) {
    std::vector<std::span<const Index>> pieces;
    for (auto begin = dust.beside.begin(); begin != dust.beside.end();) {
        const auto end = std::find_if(begin, dust.beside.end(), [&](Index v) {
            return standing.component[v] != standing.component[*begin];
        });
        pieces.emplace_back(begin, end);
        begin = end;
    }
    const auto largest = std::ranges::max_element(
        pieces, {}, [&](const auto& piece) { return standing.size[standing.component[piece.front()]]; });
    for (auto piece = pieces.begin(); piece != pieces.end(); ++piece)
        if (piece != largest) links.push_back(shortest_between(*piece, *largest, positions));
}

} // namespace

std::optional<JoinedGraph> with_hanging_outliers(const Graph& graph, std::span<const float> positions,
                                                 Workers& workers, Progress& progress) {
    progress.step("looking for outliers", 0);
    const Spacings spacings = find_spacings(graph, positions, workers);
    progress.step("looking for outliers", 0.5);
    const std::vector<std::uint8_t> outlier = find_outliers(graph, positions, spacings, workers);
    if (std::ranges::find(outlier, 1) == outlier.end()) return std::nullopt;
    const std::vector<std::uint8_t> without = between_standing(graph, outlier, workers);
    const Components standing = find_components(graph, without, workers);
    JoinedGraph result;
    result.hanging = outlier;
    Links links;
    for_all_dust(graph, standing, outlier, [&](const Dust& dust) {
        if (dust.beside.empty())
            for (const Index v : dust.outliers) result.hanging[v] = 0;
        else
            tie_pieces(dust, standing, positions, links);
    });
    result.bridges = links.size();
    progress.step("looking for outliers", 0.9);
    std::vector<Index> group(graph.size());
    for (std::size_t v = 0; v < group.size(); ++v) group[v] = outlier[v] ? no_index : 0;
    for (const auto& hook : find_hooks(group_tree(positions, group, workers), workers)) {
        if (!result.hanging[hook.first]) continue;
        links.push_back(hook);
        ++result.outliers;
    }
    if (result.outliers == 0) return std::nullopt;
    result.graph = rewired(graph, between_standing(graph, result.hanging, workers), links, workers);
    return result;
}

JoinedGraph bridged(const Graph& graph, std::span<const float> positions, Workers& workers,
                    Progress& progress) {
    progress.step("joining parts", 0);
    if (graph.size() == 0) return {graph, {}};
    const Spacings spacings = find_spacings(graph, positions, workers);
    progress.step("joining parts", 0.2);
    JoinedGraph result;
    result.hanging = find_outliers(graph, positions, spacings, workers);
    progress.step("joining parts", 0.5);
    const std::vector<std::uint8_t> stays = between_standing(graph, result.hanging, workers);
    const Components components = find_components(graph, stays, workers);
    const std::vector<Index> group = standing(components, result.hanging);
    const GroupTree tree = group_tree(positions, group, workers);
    Links links = find_bridges(tree, spacings.around, components, workers);
    result.bridges = links.size();
    progress.step("joining parts", 0.7);
    const Links hooks = find_hooks(tree, workers);
    result.outliers = hooks.size();
    links.insert(links.end(), hooks.begin(), hooks.end());
    result.graph = rewired(graph, stays, links, workers);
    return result;
}

} // namespace knead

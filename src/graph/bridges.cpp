#include "graph/bridges.h"

#include "graph/dust.h"
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
    std::vector<Index> group = components.component.of_all();
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

} // namespace

std::optional<JoinedGraph> with_hanging_outliers(const Graph& graph, std::span<const float> positions,
                                                 Workers& workers, Progress& progress) {
    progress.step("looking for outliers", 0);
    const Spacings spacings = find_spacings(graph, positions, workers);
    progress.step("looking for outliers", 0.5);
    const std::vector<std::uint8_t> outlier = find_outliers(graph, positions, spacings, workers);
    if (std::ranges::find(outlier, 1) == outlier.end()) return std::nullopt;
    const Components pieces = find_components(graph, between_standing(graph, outlier, workers), workers);
    Dust dust = gather_dust(graph, pieces, outlier, positions);
    JoinedGraph result;
    result.hanging = std::move(dust.hanging);
    result.joints = dust.ties.size();
    Links links = std::move(dust.ties);
    progress.step("looking for outliers", 0.9);
    std::vector<Index> group(graph.size()); // nothing hangs on an outlier, whether that hangs or not
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

namespace {

// Two parts that are nearest to each other name the same link, each from its own end.
std::size_t count_different(Links links) {
    for (auto& [one, other] : links)
        if (other < one) std::swap(one, other);
    std::ranges::sort(links);
    return static_cast<std::size_t>(std::unique(links.begin(), links.end()) - links.begin());
}

} // namespace

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
    result.joints = count_different(links);
    progress.step("joining parts", 0.7);
    const Links hooks = find_hooks(tree, workers);
    result.outliers = hooks.size();
    links.insert(links.end(), hooks.begin(), hooks.end());
    result.graph = rewired(graph, stays, links, workers);
    return result;
}

} // namespace knead

#include "graph/bridges.h"

#include "graph/disjoint_sets.h"
#include "graph/dust.h"
#include "graph/group_tree.h"
#include "graph/outliers.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace knead {

namespace {

constexpr std::size_t grain = 256;

using Links = std::vector<std::pair<Index, Index>>;

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

// Every vertex that stands to the nearest one of another body, within the reach of both. Bodies have numbers
// below `bodies`.
Links find_bridges_once(const GroupTree& tree, std::size_t bodies, std::span<const float> reach,
                        Workers& workers) {
    // The largest body need not ask: the others do. Of two that are as large both ask, or the order of the
    // points would decide.
    std::vector<std::size_t> size(bodies, 0);
    for (const Index body : tree.group)
        if (body != no_index) ++size[body];
    const auto found = std::ranges::max_element(size);
    const bool is_only_one = bodies > 0 && std::ranges::count(size, *found) == 1;
    const Index largest = is_only_one ? static_cast<Index>(found - size.begin()) : no_index;
    const auto across = [&](std::size_t v) {
        if (tree.group[v] == no_index || tree.group[v] == largest) return no_index;
        return nearest_within_both(tree, v, reach).vertex;
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

// Joins the bodies that the ends of these links stand in. `body`: of each vertex, below `bodies`; no_index
// where it hangs.
void join_bodies(const Links& links, std::size_t bodies, std::vector<Index>& body) {
    std::vector<Index> parent(bodies);
    std::iota(parent.begin(), parent.end(), Index{0});
    for (const auto& [one, other] : links) join(parent, body[one], body[other]);
    for (Index& each : body)
        if (each != no_index) each = find_root(parent, each);
}

// Until no body finds another: what lies between two that reach each other may have been nearer to both.
// `body`: the component of each vertex, and then what that became.
Links find_bridges(std::span<const float> positions, std::span<const float> reach, std::size_t bodies,
                   std::vector<Index>& body, Workers& workers) {
    Links links;
    for (;;) {
        const Links more = find_bridges_once(group_tree(positions, body, workers), bodies, reach, workers);
        if (more.empty()) return links;
        links.insert(links.end(), more.begin(), more.end());
        join_bodies(more, bodies, body);
    }
}

} // namespace

JoinedGraph bridged(const Graph& graph, std::span<const float> positions, Workers& workers,
                    Progress& progress) {
    progress.step("joining parts", 0);
    if (graph.size() == 0) return {graph, {}};
    Spacings spacings = find_spacings(graph, positions, workers);
    progress.step("joining parts", 0.2);
    JoinedGraph result;
    result.hanging = find_outliers(graph, positions, spacings, workers);
    progress.step("joining parts", 0.5);
    const std::vector<std::uint8_t> stays = between_standing(graph, result.hanging, workers);
    const Components components = find_components(graph, stays, workers);
    std::vector<Index> body = components.component.of_all();
    for (std::size_t v = 0; v < body.size(); ++v)
        if (result.hanging[v]) body[v] = no_index;
    std::vector<float> reach = std::move(spacings.around);
    for (float& each : reach) each *= static_cast<float>(widest_gap);
    Links links = find_bridges(positions, reach, components.size.size(), body, workers);
    result.joints = count_different(links);
    progress.step("joining parts", 0.7);
    const Links hooks = find_hooks(group_tree(positions, body, workers), workers);
    result.outliers = hooks.size();
    links.insert(links.end(), hooks.begin(), hooks.end());
    result.graph = rewired(graph, stays, links, workers);
    return result;
}

} // namespace knead

#include "graph/neighbors.h"

#include "base/gathered.h"
#include "base/large_pages.h"
#include "base/require.h"
#include "graph/disjoint_sets.h"
#include "graph/nearest_lists.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t vertices_a_range = 1 << 14;

// The first vertex of each vertex's component. Each worker joins what is linked inside of a range of
// vertices; few links lead out of one, to near numbers as they do.
template<typename Stays>
std::vector<Index> roots_of(const Graph& graph, Stays&& stays, Workers& workers) {
    auto parent = zeros_in_large_pages<Index>(graph.size(), workers);
    std::iota(parent.begin(), parent.end(), Index{0});
    Gathered<std::pair<Index, Index>> leaving;
    workers.for_chunks(graph.size(), vertices_a_range, [&](std::size_t begin, std::size_t end) {
        Gathered<std::pair<Index, Index>>::Block out(leaving);
        for (auto v = static_cast<Index>(begin); v < end; ++v)
            for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
                const Index u = graph.neighbor[link];
                if (u > v) break; // rows ascend, and the edge is met again from its other end
                if (!stays(link)) continue;
                if (u >= begin)
                    join(parent, v, u);
                else
                    out.push({v, u});
            }
    });
    leaving.take([&](const auto& link) { join(parent, link.first, link.second); });
    auto root = zeros_in_large_pages<Index>(graph.size(), workers);
    workers.for_each(graph.size(), vertices_a_range, [&](std::size_t v) {
        Index at = parent[v];
        while (parent[at] != at) at = parent[at];
        root[v] = at;
    });
    return root;
}

Components components_of(std::span<const Index> root) {
    std::vector<Index> component(root.size()), size;
    for (Index v = 0; v < root.size(); ++v) { // a root stands before all others of its component
        if (root[v] == v) size.push_back(0);
        component[v] = root[v] == v ? static_cast<Index>(size.size() - 1) : component[root[v]];
        ++size[component[v]];
    }
    return {{std::move(component), size.size()}, std::move(size)};
}

} // namespace

Graph neighbor_graph(std::span<const float> positions, std::size_t k, Workers& workers, Progress& progress) {
    const std::size_t vertices = positions.size() / 3;
    k = std::min(k, vertices > 0 ? vertices - 1 : 0);
    if (k == 0) {
        Graph lonely;
        lonely.first.assign(vertices + 1, 0);
        return lonely;
    }
    const std::vector<Index> lists = nearest_lists(positions, k, workers, progress);
    progress.step("finding neighbours", 0.9);
    return symmetric_graph(lists, k, workers);
}

Components find_components(const Graph& graph, Workers& workers) {
    return components_of(roots_of(
        graph, [](Index) { return true; }, workers));
}

Components find_components(const Graph& graph, std::span<const std::uint8_t> stays, Workers& workers) {
    require(stays.size() == graph.neighbor.size(), "a word on every link");
    return components_of(roots_of(
        graph, [&](Index link) { return stays[link] != 0; }, workers));
}

} // namespace knead

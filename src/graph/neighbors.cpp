#include "graph/neighbors.h"

#include "graph/nearest_lists.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <numeric>

namespace knead {

namespace {

Index find_root(std::vector<Index>& parent, Index v) {
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
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

Components find_components(const Graph& graph) {
    std::vector<Index> parent(graph.size());
    std::iota(parent.begin(), parent.end(), Index{0});
    for (Index v = 0; v < graph.size(); ++v) {
        for (const Index u : graph.row(v)) {
            if (u > v) break; // rows ascend, and the edge is met again from its other end
            const Index a = find_root(parent, v);
            const Index b = find_root(parent, u);
            if (a != b) parent[std::max(a, b)] = std::min(a, b);
        }
    }
    Components components;
    components.component.resize(graph.size());
    for (Index v = 0; v < graph.size(); ++v) {
        const Index root = find_root(parent, v);
        if (root == v) components.size.push_back(0);
        components.component[v] =
            root == v ? static_cast<Index>(components.size.size() - 1) : components.component[root];
        ++components.size[components.component[v]];
    }
    return components;
}

} // namespace knead

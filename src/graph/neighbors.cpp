#include "graph/neighbors.h"

#include "graph/symmetric_graph.h"

#include <flann/flann.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace knead {

namespace {

using KdTree = flann::KDTreeSingleIndex<flann::L2_Simple<float>>;

// FLANN compares squared distances in float; a power of two brings the largest coordinate near 1 without
// rounding, so that neither huge nor tiny units overflow or vanish.
std::vector<float> scaled_near_one(std::span<const float> positions) {
    float largest = 0;
    for (const float value : positions) largest = std::max(largest, std::abs(value));
    int exponent = 0;
    if (largest > 0) std::frexp(largest, &exponent);
    std::vector<float> scaled(positions.size());
    std::ranges::transform(positions, scaled.begin(),
                           [&](float value) { return std::ldexp(value, -exponent); });
    return scaled;
}

// The k nearest others of the vertices begin … end.
void search_range(const KdTree& tree, const std::vector<float>& positions, std::size_t k, std::size_t begin,
                  std::size_t end, std::span<Index> lists) {
    const std::size_t count = end - begin;
    // One more, since the nearest is the vertex itself.
    std::vector<std::size_t> found(count * (k + 1));
    std::vector<float> distances(found.size());
    flann::Matrix<float> queries(const_cast<float*>(positions.data()) + 3 * begin, count, 3);
    flann::Matrix<std::size_t> indices(found.data(), count, k + 1);
    flann::Matrix<float> squared(distances.data(), count, k + 1);
    flann::SearchParams exact(flann::FLANN_CHECKS_UNLIMITED, 0.0F, true);
    tree.knnSearch(queries, indices, squared, k + 1, exact);

    for (std::size_t i = 0; i < count; ++i) {
        Index* list = lists.data() + (begin + i) * k;
        const std::size_t* row = found.data() + i * (k + 1);
        // Where squared distances vanish the vertex itself may be missing from the list: then the last one
        // goes.
        std::size_t kept = 0;
        for (std::size_t j = 0; j <= k && kept < k; ++j)
            if (row[j] != begin + i) list[kept++] = static_cast<Index>(row[j]);
    }
}

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
    progress.step("finding neighbours", 0);
    std::vector<float> scaled = scaled_near_one(positions);
    KdTree tree(flann::Matrix<float>(scaled.data(), vertices, 3), flann::KDTreeSingleIndexParams(12, true));
    tree.buildIndex();

    // Searches in blocks, so that a long one can be stopped.
    std::vector<Index> lists(vertices * k, no_index);
    constexpr std::size_t block = 1 << 18;
    for (std::size_t begin = 0; begin < vertices; begin += block) {
        progress.step("finding neighbours",
                      0.3 + 0.6 * static_cast<double>(begin) / static_cast<double>(vertices));
        workers.for_chunks(std::min(block, vertices - begin), 2048, [&](std::size_t from, std::size_t to) {
            search_range(tree, scaled, k, begin + from, begin + to, lists);
        });
    }
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

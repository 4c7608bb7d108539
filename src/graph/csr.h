#pragma once
// A graph in compressed rows.

#include "base/types.h"

#include <algorithm>
#include <optional>
#include <span>
#include <vector>

namespace knead {

// The neighbours of vertex v are neighbor[first[v]] … neighbor[first[v + 1] - 1], ascending, without v itself
// and without repetition. All graphs here are symmetric: u is a neighbour of v exactly if v is one of u.
struct Graph {
    std::vector<Index> first; // one entry a vertex, and the end
    std::vector<Index> neighbor;

    std::size_t size() const { return first.empty() ? 0 : first.size() - 1; }
    std::span<const Index> row(std::size_t v) const {
        return {neighbor.data() + first[v], neighbor.data() + first[v + 1]};
    }
};

// Where in graph.neighbor the link from v to u stands.
inline std::optional<Index> find_link(const Graph& graph, std::size_t v, Index u) {
    const auto row = graph.row(v);
    const auto found = std::ranges::lower_bound(row, u);
    if (found == row.end() || *found != u) return std::nullopt;
    return graph.first[v] + static_cast<Index>(found - row.begin());
}

// For every link of a symmetric graph the place of its opposite: result[link from v to u] is the link from u
// to v.
inline std::vector<Index> reverse_links(const Graph& graph) {
    std::vector<Index> next = graph.first; // rows are ascending, so their opposites come in this order
    std::vector<Index> opposite(graph.neighbor.size());
    for (std::size_t link = 0; link < opposite.size(); ++link) opposite[link] = next[graph.neighbor[link]]++;
    return opposite;
}

} // namespace knead

#pragma once
// The paper's Algorithm 1, as plainly as it can be said: the yardstick for the flood.

#include "graph/flood.h"

#include <algorithm>
#include <vector>

namespace knead::test {

struct Reached {
    unsigned hops;
    Index sample;
    auto operator<=>(const Reached&) const = default;
};

// Searches the graph breadth-first from `start` until the level is finished on which the K-th sample was met;
// the first K by (hops, sample index).
inline std::vector<Reached> algorithm1(const Graph& graph, const std::vector<Index>& samples, Index start,
                                       std::size_t k = influences_per_row) {
    std::vector<Index> sample_at(graph.size(), no_index);
    for (Index s = 0; s < samples.size(); ++s) sample_at[samples[s]] = s;
    std::vector<bool> seen(graph.size(), false);
    std::vector<Index> level{start};
    seen[start] = true;
    std::vector<Reached> found;
    for (unsigned hops = 0; !level.empty() && found.size() < k; ++hops) {
        std::vector<Index> next;
        for (const Index v : level) {
            if (sample_at[v] != no_index) found.push_back({hops, sample_at[v]});
            for (const Index u : graph.row(v))
                if (!seen[u]) {
                    seen[u] = true;
                    next.push_back(u);
                }
        }
        level = std::move(next);
    }
    std::ranges::sort(found);
    if (found.size() > k) found.resize(k);
    return found;
}

} // namespace knead::test

#pragma once
// Dijkstra searches from one point, the yardstick for the flood along link_lengths().

#include "graph/algorithm1.h"
#include "graph/link_lengths.h"

#include <queue>
#include <span>
#include <utility>

namespace knead::test {

// Algorithm 1 with lengths: the first k samples by (distance, sample number). `lengths`: one entry for every
// entry of graph.neighbor.
inline std::vector<Reached> nearest_by_length(const Graph& graph, std::span<const std::uint8_t> lengths,
                                              const std::vector<Index>& samples, Index start,
                                              std::size_t k = influences_per_row) {
    std::vector<Index> sample_at(graph.size(), no_index);
    for (Index s = 0; s < samples.size(); ++s) sample_at[samples[s]] = s;
    using Waiting = std::pair<unsigned, Index>; // distance, vertex
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
    std::vector<bool> done(graph.size(), false);
    std::vector<Reached> found;
    waiting.emplace(0, start);
    while (!waiting.empty()) {
        const auto [distance, v] = waiting.top();
        waiting.pop();
        if (done[v]) continue;
        done[v] = true;
        // Vertices come by distance: beyond the k-th sample's there is nothing to find.
        if (found.size() >= k && distance > found[k - 1].hops) break;
        if (sample_at[v] != no_index) found.push_back({distance, sample_at[v]});
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link)
            if (!done[graph.neighbor[link]]) waiting.emplace(distance + lengths[link], graph.neighbor[link]);
    }
    std::ranges::sort(found);
    if (found.size() > k) found.resize(k);
    return found;
}

// How far every vertex is from one, no_index where no way leads.
inline std::vector<Index> ways_from(const Graph& graph, std::span<const std::uint8_t> lengths, Index start) {
    std::vector<Index> way(graph.size(), no_index);
    using Waiting = std::pair<Index, Index>; // distance, vertex
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> waiting;
    waiting.emplace(0, start);
    while (!waiting.empty()) {
        const auto [distance, v] = waiting.top();
        waiting.pop();
        if (way[v] != no_index) continue;
        way[v] = distance;
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link)
            if (way[graph.neighbor[link]] == no_index)
                waiting.emplace(distance + lengths[link], graph.neighbor[link]);
    }
    return way;
}

} // namespace knead::test

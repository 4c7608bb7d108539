#pragma once
// The neighbourhood graph of the points, and what hangs together in it.

#include "base/progress.h"
#include "base/workers.h"
#include "graph/csr.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// Links every vertex to its k nearest others (all others, if there are fewer), exactly, by FLANN, and back.
// `positions`: 3 floats a vertex, finite and pairwise different. k ≥ 1.
Graph neighbor_graph(std::span<const float> positions, std::size_t k, Workers& workers, Progress& progress);

// Which vertices hang together: component[v] numbers them by their lowest vertex, from 0.
struct Components {
    std::vector<Index> component;
    std::vector<Index> size; // vertices in each
};
Components find_components(const Graph& graph, Workers& workers);

// The same of those links alone whose entry in `stays` is not 0: one for every entry of graph.neighbor, the
// same for both directions of a link.
Components find_components(const Graph& graph, std::span<const std::uint8_t> stays, Workers& workers);

} // namespace knead

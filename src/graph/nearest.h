#pragma once
// The nearest neighbours of a vertex, out of its row of the graph.

#include "graph/csr.h"

#include <array>
#include <span>
#include <utility>

namespace knead {

// Nearest first; of equal distances the lower vertex.
struct Nearest {
    static constexpr std::size_t most = 5;
    std::array<std::pair<float, Index>, most> near; // distance and vertex
    std::size_t count = 0;
};

// A row holds, beside the nearest, whoever counts v among its own, from however far. `positions`: 3 floats a
// vertex.
Nearest find_nearest(const Graph& graph, std::span<const float> positions, std::size_t v);

} // namespace knead

#pragma once
// What outliers lie between, where parts are not bridged: a step of with_hanging_outliers()
// (graph/bridges.h).

#include "graph/neighbors.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace knead {

struct Dust {
    std::vector<std::uint8_t> hanging; // of each vertex: 1 for an outlier that is linked, through others, to
                                       // one that is none
    // Links between pieces that only outliers tied together: as few as keep them together, short ones first.
    std::vector<std::pair<Index, Index>> ties;
};

// `pieces`: the components without outliers, each outlier one by itself; `outlier`: of each vertex, 1 if it
// is one; `positions`: 3 floats a vertex.
Dust gather_dust(const Graph& graph, const Components& pieces, std::span<const std::uint8_t> outlier,
                 std::span<const float> positions);

} // namespace knead

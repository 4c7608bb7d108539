#pragma once
// Some of the vertices, to sum up over the surface what would take too long to ask of all.

#include "base/workers.h"
#include "graph/csr.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

struct ChosenVertices {
    std::vector<Index> vertex; // ascending
    std::vector<double> each;  // of each: for how many vertices it stands, 1 or more
    bool all = true;           // that there were to choose from
};

// `count` of so many vertices, or all there are, one as probable as the other: evenly along their order.
ChosenVertices choose_by_number(std::size_t vertices, std::size_t count);

// At most `count` of the vertices, and hardly fewer, or all if there are no more, evenly spread over the
// surface: a vertex is as probable as the mean square of its links is long, up to certain. So where points
// lie twenty times denser than elsewhere a part of the surface is asked no more often for it, and each speaks
// for the more of them. `lengths`: link_lengths(), by which alone what is chosen is decided, so that links
// count as no shorter and no longer than these tell; `hanging`: of each vertex 1 for an outlier, which is not
// chosen; empty without any. Evenly along the order of the vertices; the same for any number of workers.
ChosenVertices choose_by_area(const Graph& graph, std::span<const std::uint8_t> lengths,
                              std::span<const std::uint8_t> hanging, std::size_t count, Workers& workers);

} // namespace knead

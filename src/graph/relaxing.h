#pragma once
// Samples spaced evenly along the surface.

#include "base/progress.h"
#include "base/workers.h"
#include "graph/csr.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// Moves samples to the middle of what they are nearest to: each round floods the graph from all of them, and
// each goes to the vertex of its territory that is nearest to the territory's mean position (Lloyd's method
// along the surface). Cells of an octree are up to twice as long as wide, all the same way, and samples left
// at their centres would link along rows only. A few rounds leave them evenly spaced in all directions, and
// still denser where the points are. `barred`: of each vertex, not 0 where it neither counts nor becomes a
// sample; no sample is one to begin with. Empty: there are none.
std::vector<Index> relaxed(std::vector<Index> samples, const Graph& graph,
                           std::span<const std::uint8_t> lengths, std::span<const float> positions,
                           std::span<const std::uint8_t> barred, int rounds, Workers& workers,
                           Progress& progress);

} // namespace knead

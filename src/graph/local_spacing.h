#pragma once
// How far apart points lie, place by place.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <span>
#include <vector>

namespace knead {

// Of every vertex, the distance to its fifth nearest neighbour (the farthest, where it has fewer; 0: it has
// none), but hardly more than where its neighbours lie: a stray point has a dense surface for its neighbours,
// and is not one of a sparse one. Nor is it much more than the second nearest of those around: along a line,
// as a scanner draws them far away, the fifth is three steps off. Nor more than twice what 95 % of the
// vertices have at most, as strays may have each other for neighbours, or three times what half of them have:
// the far end of a scan, as wide as points lie apart there, would be a heap of balls. `positions`: 3 floats a
// vertex.
std::vector<float> local_spacing(const Graph& graph, std::span<const float> positions, Workers& workers);

// The same of every ordered point: that of its vertex. `positions`: 3 floats a point.
std::vector<float> spacing_of_points(const PointOrder& order, const Graph& graph,
                                     std::span<const float> positions, Workers& workers);

} // namespace knead

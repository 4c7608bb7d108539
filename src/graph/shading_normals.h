#pragma once
// Normals to shade a cloud with whose file has none.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <span>
#include <vector>

namespace knead {

// A unit normal at every vertex, up to its sign, which is left to chance: that of the plane through its
// neighbours or, where these are no surface, as where scans overlap and do not quite fit, through them when
// all were drawn together, each to the mean of its neighbours; evened out among neighbours. For looking at
// only; a saved file gets none. `positions`: 3 floats a vertex.
std::vector<float> shading_normals(const Graph& graph, std::span<const float> positions, Workers& workers);

// The points' normals from those of their vertices. `vertex`: of each point (PointOrder).
std::vector<float> spread_to_points(std::span<const float> vertex_normals, const Numbering& vertex);

} // namespace knead

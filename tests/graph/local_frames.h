#pragma once
// A local frame at every vertex from the principal axes of its neighbourhood, as the paper's Equation (1) has
// them.

#include "base/workers.h"
#include "graph/csr.h"

#include <span>
#include <vector>

namespace knead {

// The principal axes of a vertex and its neighbours: unit quaternions that turn x, y, z into the directions
// of the largest, the middle and the smallest spread. The last is the surface's normal, up to its sign:
// neighbouring frames are not oriented alike, and nothing here needs them to be (deform/sample_system.h). A
// vertex without neighbours gets the identity. `positions`: 3 floats a vertex.
std::vector<Quatd> local_frames(const Graph& graph, std::span<const float> positions, Workers& workers);

} // namespace knead

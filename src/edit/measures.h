#pragma once
// How far and how much a shape was changed, point by point, for colours and for saving.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <span>
#include <vector>

namespace knead {

// How far each point went from where it was opened, in the cloud's units. 3n floats each, in one order.
std::vector<float> displacements(std::span<const float> opened, std::span<const float> now, Workers& workers);

// The mean ratio of the lengths of a point's links now to those when opened; 1 for a point without links.
// 3n floats each, in the order of computation; `graph` links its vertices. Points at one position share the
// value of the first of them.
std::vector<float> local_stretch(const PointOrder& order, const Graph& graph, std::span<const float> opened,
                                 std::span<const float> now, Workers& workers);

// One value a point from the order of computation into that of the file; `left_out` for points that the order
// leaves out.
std::vector<float> in_file_order(const PointOrder& order, std::span<const float> ordered,
                                 std::size_t file_points, float left_out, Workers& workers);

} // namespace knead

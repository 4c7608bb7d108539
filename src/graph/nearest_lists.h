#pragma once
// Each vertex's nearest others, by FLANN.

#include "base/progress.h"
#include "base/types.h"
#include "base/workers.h"

#include <cstddef>
#include <span>
#include <vector>

namespace knead {

// The k nearest others of every vertex: k numbers a vertex, nearest first, equally near ones by their
// scrambled() numbers (distances are compared as squares, in double). `positions`: 3 floats a vertex, finite
// and pairwise different, in Morton order (PointOrder); in any other the search is right but slow. 1 ≤ k <
// number of vertices. The vertices are shared out between trees of at most `most_a_tree`, which changes
// nothing in the result. Beside that it holds some 40 bytes a vertex while it works.
inline constexpr std::size_t usual_tree = 1 << 16; // stays in a core's cache
std::vector<Index> nearest_lists(std::span<const float> positions, std::size_t k, Workers& workers,
                                 Progress& progress, std::size_t most_a_tree = usual_tree);

} // namespace knead

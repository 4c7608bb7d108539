#pragma once
// Samples by an octree over the point set.

#include "base/types.h"
#include "graph/point_order.h"

#include <span>
#include <vector>

namespace knead {

// Which vertex of a cell is the sample: the one nearest to the middle, the mean position of its vertices, or
// nearest to halfway from there to any one of them, always the same but following no direction. Middles lie
// in rows along the axes, for every other count twice as far apart one way as the other; relaxing.h leaves
// rows that it finds, and what is bent between them shows them as ripples.
enum class OfCell { middle, aside };

// `count` of the vertices: cells of an octree are halved (along x, then y, then z, so three halvings are one
// step of an octree), always the one with most vertices times edge, until there are `count` of them; each
// gives one vertex. Where a surface has 27 times as many points as elsewhere, samples so are 3 times as
// close: by number alone they would be 5 times as close and too few elsewhere, by size alone a dense detail
// would get none.
//
// `positions`: 3 floats a vertex, along the curve through `cube`; `among`: the vertices to choose from,
// ascending. Returns vertices, ascending; all of `among` if there are no more than `count`.
std::vector<Index> octree_samples(const MortonCube& cube, std::span<const float> positions,
                                  std::span<const Index> among, std::size_t count,
                                  OfCell which = OfCell::middle);

} // namespace knead

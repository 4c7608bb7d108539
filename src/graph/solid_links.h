#pragma once
// More links where points fill a solid.

#include "base/workers.h"
#include "graph/csr.h"

#include <cstddef>
#include <span>

namespace knead {

// So many links a vertex in a solid asks for, and as many may come back.
constexpr std::size_t links_in_solid = 14;

// `points` and further links, where the vertices lie throughout a volume: there each is linked to the 14
// nearest of its neighbours and of theirs, all that are as near as the fourteenth included, and back.
//
// For an even stretch to be in balance the pulls on each vertex have to cancel, Σ_j w_ij e_ij = 0
// (edge_weights.h): two conditions a vertex on a surface, three in a solid. The six nearest neighbours and
// their back links leave each vertex some 3½ weights of its own, as a link has one for its two ends, and for
// weights that are all to be > 0 that is enough on a surface, but not in a solid. What is left over makes
// short links take what the long ones should, the samples see less stretch than there is, and a solid that is
// pulled contracts by up to an eighth less than its material says. On a surface six is also how many
// neighbours a cell of an even sampling has; in a solid these are 14, the faces of Kelvin's cell, to 15.5 on
// the mean of random cells (J. L. Meijering, "Interface area, edge length, and number of vertices in crystal
// aggregates with random nucleation", 1953).
//
// A vertex is in a solid where links go into all directions, at it and at three of four vertices up to two
// links away, these together are not flat, and three of four of them have such surroundings as well. The
// edges and corners of a surface have not, and a surface with noise of half a spacing has flat ones: their
// links stay what they were. Components do, too, and a vertex with a single link keeps to it.
//
// `points`: symmetric. `positions`: 3 floats a vertex. The same for any number of workers.
Graph with_solid_links(const Graph& points, std::span<const float> positions, Workers& workers);

} // namespace knead

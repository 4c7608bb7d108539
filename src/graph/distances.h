#pragma once
// How far vertices are from a set of them, along the graph.

#include "graph/csr.h"

#include <span>
#include <vector>

namespace knead {

struct Reached {
    Index vertex = 0;
    double distance = 0; // along links, in the units of the positions
};

// All vertices within `limit` of the nearest of the sources, the sources among them with 0, in the order of
// their distances (Dijkstra; of equal ones the lower vertex first). `positions`: 3 floats a vertex. Costs
// what is reached, beside one number a vertex.
std::vector<Reached> reached_within(const Graph& graph, std::span<const float> positions,
                                    std::span<const Index> sources, double limit);

} // namespace knead

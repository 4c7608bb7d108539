#pragma once
// How far vertices are from a set of them, along the graph.

#include "graph/csr.h"

#include <atomic>
#include <span>
#include <vector>

namespace knead {

struct Reached {
    Index vertex = 0;
    double distance = 0; // along links, in the units of the positions
    Index source = 0;    // from this one
};

// All vertices within `limit` of the nearest of the sources, which are different: the sources themselves, as
// they are given, with 0, and then the others in the order of their distances (Dijkstra; of equal ones the
// lower vertex first). `positions`: 3 floats a vertex. Costs what is reached, as long as neighbours have near
// numbers (PointOrder). `stop`: once it holds true, what was reached so far is returned.
std::vector<Reached> reached_within(const Graph& graph, std::span<const float> positions,
                                    std::span<const Index> sources, double limit,
                                    const std::atomic<bool>* stop = nullptr);

} // namespace knead

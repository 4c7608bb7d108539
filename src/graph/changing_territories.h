#pragma once
// The territories of samples and where they touch, while samples come and go at the end of their list.

#include "graph/flood.h"
#include "graph/territory_borders.h"

#include <span>
#include <vector>

namespace knead {

// What the flood from some samples changed.
struct TerritoryFlood {
    std::vector<FloodStart> starts;
    TerritoryPatch patch;
};

// Territories of base samples, and of samples that were added to them, flood upon flood.
struct ChangingTerritories {
    TerritoryRows nearest; // of each vertex, with those that were added
    // Between territories of base samples, then with the first of the floods, with the second, ...
    std::vector<std::vector<TerritoryBorder>> borders;
    std::vector<TerritoryFlood> floods;
};

// Those of base samples alone; `nearest`: the flood from them over the graph `points`.
ChangingTerritories territories_of_base(const InfluenceRows& nearest, const Graph& points, Workers& workers);

// Makes `added` the samples beside the base samples, flood upon flood, and returns the borders of all: those
// of territory_borders_after() each. Only what follows upon the first that is another flood than before is
// flooded. Whoever is cancelled leaves territories that are good for nothing.
std::span<const TerritoryBorder> change_added(ChangingTerritories& territories,
                                              std::vector<std::vector<FloodStart>> added, const Graph& points,
                                              std::span<const std::uint8_t> lengths, Workers& workers,
                                              Progress& progress);

// The base sample that is the nearest to each of these vertices, which are different; no_index where none is.
std::vector<Index> nearest_of_base(const ChangingTerritories& territories, std::span<const Index> vertices,
                                   Workers& workers);

} // namespace knead

#pragma once
// The territories of samples and where they touch, while some of the samples come and go.

#include "graph/starts_flood.h"
#include "graph/territory_borders.h"

#include <span>
#include <vector>

namespace knead {

// Territories of base samples, and of samples that were added to them.
//
// Samples are numbered through, so that the numbers of all change that come after one which comes or goes.
// Here those that were added have numbers of the same order that they keep, with room between them.
struct ChangingTerritories {
    TerritoryRows nearest;                     // of each vertex, with those that were added
    AddedStarts<1> added;                      // that are in these, by their own numbers
    std::vector<TerritoryBorder> borders;      // of all, by the same
    std::vector<TerritoryBorder> base_borders; // of base samples, as if none had been added
};

// Those of base samples alone; `nearest`: the flood from so many of them over the graph `points`.
ChangingTerritories territories_of_base(const InfluenceRows& nearest, std::size_t base, const Graph& points,
                                        Workers& workers);

// Makes the samples at these vertices, none of which holds a base sample, those that are there beside the
// base samples, numbered on from these. Returns all borders: territory_borders(), with the ways of those that
// were added. Only what samples reach that come or go is flooded. Whoever is cancelled leaves territories
// that are good for nothing.
std::vector<TerritoryBorder> change_added(ChangingTerritories& territories, std::span<const Index> added,
                                          const Graph& points, std::span<const std::uint8_t> lengths,
                                          Workers& workers, Progress& progress);

// The sample that is the nearest to each of these vertices, those that were added numbered on from the base
// samples; no_index where none is.
std::vector<Index> nearest_samples(const ChangingTerritories& territories, std::span<const Index> vertices,
                                   Workers& workers);

// The base sample that is the nearest to each of these vertices; no_index where none is.
std::vector<Index> nearest_of_base(const ChangingTerritories& territories, std::span<const Index> vertices);

} // namespace knead

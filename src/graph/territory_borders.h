#pragma once
// Where the territories of samples touch. A sample's territory is the vertices that it is the nearest sample
// of.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/flood.h"

#include <span>
#include <vector>

namespace knead {

// Two samples whose territories touch, a < b, how many links of the point graph go from the one to the other
// (> 0), and the shortest way from sample to sample by one of these, in levels. That is told of added samples
// alone: where a and b are others it is no_index.
struct TerritoryBorder {
    Index a = 0, b = 0;
    Index links = 0;
    Index way = no_index;
    bool operator==(const TerritoryBorder&) const = default;
};

// All borders, ascending by (a, b). `nearest`: the flood from the samples over the graph `points`.
std::vector<TerritoryBorder> territory_borders(const TerritoryRows& nearest, const Graph& points,
                                               Workers& workers);

// The same after add_territories() made `nearest` of the rows that `before` are the borders of, and `patch`
// with it; `lengths` are those of the links. Only vertices that another sample has become the nearest of are
// looked at.
std::vector<TerritoryBorder> territory_borders_after(std::span<const TerritoryBorder> before,
                                                     const TerritoryPatch& patch,
                                                     const TerritoryRows& nearest, const Graph& points,
                                                     std::span<const std::uint8_t> lengths, Workers& workers);

} // namespace knead

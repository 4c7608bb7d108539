#pragma once
// Where the territories of samples touch. A sample's territory is the vertices that it is the nearest sample
// of.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/starts_flood.h"

#include <span>
#include <vector>

namespace knead {

// Two samples whose territories touch, a < b, how many links of the point graph go from the one to the other
// (> 0), and the shortest way from sample to sample by one of these, in levels. That is told of samples that
// were added (starts_flood.h) alone: where b is another it is no_index.
struct TerritoryBorder {
    Index a = 0, b = 0;
    Index links = 0;
    Index way = no_index;
    bool operator==(const TerritoryBorder&) const = default;
};

// All borders, ascending by (a, b). `nearest`: the flood from the samples over the graph `points`, none of
// which was added.
std::vector<TerritoryBorder> territory_borders(const TerritoryRows& nearest, const Graph& points,
                                               Workers& workers);

// The same after change_starts(added, ...) made `nearest` of the rows that `before` are the borders of, and
// returned `former`; `lengths` are those of the links. Looked at are vertices that another sample has become
// the nearest of, and, where the shortest way went, the territory of the one that was added.
std::vector<TerritoryBorder> territory_borders_after(std::span<const TerritoryBorder> before,
                                                     const TerritoryPatch& former,
                                                     const AddedStarts<1>& added,
                                                     const TerritoryRows& nearest, const Graph& points,
                                                     std::span<const std::uint8_t> lengths, Workers& workers);

} // namespace knead

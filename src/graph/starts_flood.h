#pragma once
// Floods of starts that come and go.

#include "graph/flood.h"

#include <span>
#include <vector>

namespace knead {

// What the flood from some starts changed.
template<std::size_t places>
struct StartsFlood {
    std::vector<FloodStart> starts;
    RowPatch<places> patch;
};

// Brings rows from the starts that `floods` hold, one flood upon the other, to those of `starts`, each of
// which is there once, and `floods` with them: as add_starts() would from rows without any. The order makes
// no difference. Floods of starts that are all still there stay, as long as the ones that they were made upon
// do; what is left of the others, and what is new, are a flood each from then on. `changed`: a byte a block
// of rows (blocks_of_rows()), set to 1 where any of them may be another one afterwards. A flood that is
// cancelled leaves `nearest` good for nothing.
void change_starts(std::vector<StartsFlood<influences_per_row>>& floods, std::span<const FloodStart> starts,
                   InfluenceRows& nearest, std::span<std::uint8_t> changed, const Graph& graph,
                   std::span<const std::uint8_t> lengths, Workers& workers, Progress& progress);

// The rows of these vertices, which are different, as they would be without any of the floods.
template<std::size_t places>
std::vector<SampleRow<Index, places>> rows_without(std::span<const StartsFlood<places>> floods,
                                                   const NearestRows<places>& nearest,
                                                   std::span<const Index> vertices, Workers& workers);

} // namespace knead

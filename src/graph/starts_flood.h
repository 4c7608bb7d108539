#pragma once
// Floods of starts that come and go, over the finished flood of samples that stay.

#include "graph/flood.h"

#include <span>
#include <vector>

namespace knead {

// What is in the rows beside the samples that stay: starts whose numbers are not below `first_number`, which
// is above those of all samples.
//
// A row that holds any of them is kept as it is without. Rows are the K first by (distance, number), and what
// takes a start away can change no row but those that hold it: so each can go by itself, whoever came after.
template<std::size_t places>
struct AddedStarts {
    Index first_number = 0;
    std::vector<FloodStart> starts;          // ascending by number and vertex
    RowPatch<places> without;                // wide if the rows are
    std::vector<std::vector<Index>> numbers; // of each block of rows those that it holds, and perhaps more
};

// Of rows that hold no starts yet.
template<std::size_t places>
AddedStarts<places> no_starts(const NearestRows<places>& nearest, Index first_number);

// Makes the starts that the rows hold those of `starts`, each of which is there once: the rows are then what
// add_starts() would make of them without any. Only what numbers that come, go or start elsewhere reach is
// flooded. `changed`: a byte a block of rows (blocks_of_rows()), set to 1 where any of them may be another
// one afterwards. A flood that is cancelled leaves rows that are good for nothing.
void change_starts(AddedStarts<influences_per_row>& added, std::span<const FloodStart> starts,
                   InfluenceRows& nearest, std::span<std::uint8_t> changed, const Graph& graph,
                   std::span<const std::uint8_t> lengths, Workers& workers, Progress& progress);
// The same of territories. Returns those that may be others afterwards, as they were before.
TerritoryPatch change_starts(AddedStarts<1>& added, std::span<const FloodStart> starts,
                             TerritoryRows& nearest, const Graph& graph,
                             std::span<const std::uint8_t> lengths, Workers& workers, Progress& progress);

// The rows of these vertices as they would be without any of the starts.
template<std::size_t places>
std::vector<SampleRow<Index, places>> rows_without(const AddedStarts<places>& added,
                                                   const NearestRows<places>& nearest,
                                                   std::span<const Index> vertices);

} // namespace knead

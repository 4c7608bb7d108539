#pragma once
// Private to this room: an order in which the points of a chunk are kept so that a part of them that is
// spread evenly lies side by side. One in k of the points is then read from one k-th of the memory, and what
// a larger budget draws is what a smaller one drew, and more: nothing flickers where the budget changes.
//
// It is van der Corput's: the numbers 0 … 1023 with their bits reversed, those beyond the chunk left out.

#include "render/chunks.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// The place in its chunk of the point that is kept in each slot; so many points, points_in_chunk at most.
std::vector<std::uint16_t> scattered_order(std::size_t points);

// The slots of part number `part` of `parts` ≥ 1 of a chunk in that order, by the places of their points, so
// that those that follow each other lie close together. Together the parts are the chunk.
std::vector<std::uint16_t> slots_of_part(std::span<const std::uint16_t> order, std::size_t part,
                                         std::size_t parts);

// Which part of a chunk belongs to subset number `subset` of `subsets` of a cloud. Of very many subsets each
// takes points of some chunks only.
struct PartOfChunk {
    std::size_t step = 1, rest = 0; // chunks of which the number over `step` leaves `rest`; the others: none
    std::size_t part = 0, parts = 1;
};
PartOfChunk part_of_chunk(std::size_t subset, std::size_t subsets);

} // namespace knead

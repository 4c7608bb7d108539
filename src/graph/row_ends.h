#pragma once
// Which numbers rows of influences hold, block by block of them.

#include "base/workers.h"
#include "graph/influences.h"

#include <cstdint>
#include <span>

namespace knead {

// Finds one past the largest number in each block of rows (rows_in_block), 0 where they are empty. `changed`
// and `ends`: one a block; where `changed` is 0, `ends` stays as it is.
void find_row_ends(const InfluenceRows& rows, std::span<const std::uint8_t> changed, std::span<Index> ends,
                   Workers& workers);

} // namespace knead

#pragma once
// The points in blocks of consecutive ones. What a frame leaves out it leaves out block by block: points come
// in Morton order, so a part of the cloud fills few blocks but for its border.

#include "base/point_range.h"
#include "base/types.h"

#include <vector>

namespace knead {

inline constexpr std::size_t points_in_block = 256; // the last block may have fewer

constexpr std::size_t blocks_of(std::size_t points) {
    return (points + points_in_block - 1) / points_in_block;
}

inline PointRange points_of(std::size_t block, std::size_t points) {
    const std::size_t first = points_in_block * block, next = first + points_in_block;
    return {first, next < points ? next : points};
}

// What is copied to another memory is copied in so many ranges at most, as each costs something by itself.
inline constexpr std::size_t most_ranges = 64;

// Adds a block of a cloud of so many points to ranges of the blocks before it: to the last of them, with what
// lies between, if that is no more than one most_ranges-th of all blocks, so that there are never more
// ranges.
void append_block(std::size_t block, std::size_t points, std::vector<PointRange>& ranges);

} // namespace knead

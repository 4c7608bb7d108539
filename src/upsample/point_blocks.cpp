#include "upsample/point_blocks.h"

namespace knead {

void append_block(std::size_t block, std::size_t points, std::vector<PointRange>& ranges) {
    const PointRange own = points_of(block, points);
    const std::size_t most_between = points_in_block * (blocks_of(points) / most_ranges);
    if (!ranges.empty() && own.first - ranges.back().end <= most_between)
        ranges.back().end = own.end;
    else
        ranges.push_back(own);
}

} // namespace knead

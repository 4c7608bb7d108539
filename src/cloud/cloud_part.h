#pragma once
// A cloud without some of its points.

#include "cloud/point_cloud.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// The points that stay, in their order, with every attribute, relative to the same origin. It comes from no
// file, and there is nothing to say of it. `left_out`: one a point, 0 where it stays.
PointCloud part_of(const PointCloud& cloud, std::span<const std::uint8_t> left_out);

// The values of the points that stay, `each` of them a point; none of none.
std::vector<float> part_of(std::span<const float> values, std::size_t each,
                           std::span<const std::uint8_t> left_out);

} // namespace knead

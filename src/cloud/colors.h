#pragma once
// Which columns of a cloud are its colours.

#include "cloud/point_cloud.h"

#include <array>
#include <optional>

namespace knead {

// The columns red, green and blue: under these names, as diffuse_red …, or as r, g, b, in this order of
// preference; of any type.
std::optional<std::array<std::size_t, 3>> find_colors(const PointCloud& cloud);

// The column that tells how brightly a scanner's beam came back: intensity, Intensity, scalar_Intensity (as
// CloudCompare has it) or reflectance, in this order of preference; of any type.
std::optional<std::size_t> find_intensity(const PointCloud& cloud);

// What full brightness is in these columns: 255 for bytes. 16-bit columns and floats hold bytes in some
// files, which their largest value tells; floats up to 1 are fractions.
double brightest_value(const PointCloud& cloud, const std::array<std::size_t, 3>& columns);

} // namespace knead

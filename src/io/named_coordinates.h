#pragma once
// Coordinates of formats whose columns all have names. Readers only.

#include "cloud/point_cloud.h"

#include <string_view>

namespace knead {

// Takes the columns x, y and z, which the cloud has as plain scalars, for its coordinates.
inline void set_positions_from_named_columns(PointCloud& cloud) {
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    for (std::size_t axis = 0; axis < 3; ++axis)
        cloud.coordinate_columns[axis] = find_attribute(cloud, axes[axis]).value();
    set_positions_from_columns(cloud);
}

} // namespace knead

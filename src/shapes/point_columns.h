#pragma once
// A cloud in the making: its columns are filled in place, from many threads, with no copy of them beside.

#include "cloud/point_cloud.h"

#include <array>
#include <cstdint>

namespace knead {

using Colour = std::array<std::uint8_t, 3>; // red, green, blue

enum class WithNormals : bool { no, yes };
enum class WithColours : bool { no, yes };

struct PointColumns {
    PointCloud cloud; // its columns; positions come with finish()
    bool normals = false;
    bool colours = false;
};

// Columns x y z, nx ny nz if asked for, red green blue if asked for, of `points` zeros.
PointColumns make_columns(std::size_t points, WithNormals normals, WithColours colours);

// Sets point i; a normal or colour that has no column is dropped. Calls for different points may run at once.
void put_point(PointColumns& columns, std::size_t i, const Vec3d& position, const Vec3d& normal,
               Colour colour = {});

PointCloud finish(PointColumns&& columns);

} // namespace knead

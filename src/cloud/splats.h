#pragma once
// Gaussian splats: points that are small ellipsoids with a direction of their own and colours that depend on
// where they are looked at from, as "3D Gaussian Splatting for Real-Time Radiance Field Rendering" (Kerbl,
// Kopanas, Leimkühler, Drettakis 2023) saves them in a PLY file.

#include "cloud/point_cloud.h"

#include <array>
#include <optional>
#include <vector>

namespace knead {

// Which columns turn with a splat, as places in the cloud's attributes.
struct SplatColumns {
    // rot_0 … rot_3: the quaternion w x y z that turns the ellipsoid's axes into place; of any length.
    std::array<std::size_t, 4> rotation{};

    // f_rest_0 …: the spherical harmonics of bands 1 … `bands` (0 … 3), all of red, then green, then blue;
    // 3 · bands (bands + 2) columns.
    std::vector<std::size_t> harmonics;
    std::size_t bands = 0;

    // Whether there are columns f_rest_ that do not come in so many: nobody knows how they turn.
    bool other_harmonics = false;
};

// Nothing unless the cloud has scale_0 and rot_0 … rot_3, all float32 or float64.
std::optional<SplatColumns> find_splats(const PointCloud& cloud);

} // namespace knead

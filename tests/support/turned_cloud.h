#pragma once
// Clouds that stand along y.

#include "cloud/point_cloud.h"

#include <sstream>
#include <string>

namespace knead::test {

// An .xyz file of a cloud that stands along z, turned so that it stands along y.
inline std::string turned_to_y(const PointCloud& along_z) {
    std::ostringstream text;
    for (std::size_t i = 0; i < along_z.size(); ++i) {
        const Vec3d p = along_z.file_position(i);
        text << p.x() << ' ' << p.z() << ' ' << -p.y() << '\n';
    }
    return text.str();
}

} // namespace knead::test

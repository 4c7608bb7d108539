#pragma once
// Triangle meshes for CGAL: the survey's own, and what CGAL makes of points that have none.

#include "cloud/point_cloud.h"

#include <array>
#include <filesystem>
#include <vector>

namespace knead::peers {

using Triangle = std::array<Index, 3>; // the numbers of its corners, in the order of the cloud

// The faces of an OFF file. Throws Error (input) where it cannot be read or a face is no triangle.
std::vector<Triangle> read_triangles(const std::filesystem::path& path);

// The largest part of the surface that CGAL's advancing front finds through the points, all of them its
// vertices: points that it leaves out, and those of smaller parts, are not in the cloud.
struct FoundMesh {
    PointCloud cloud;
    std::vector<Triangle> triangles;
    double seconds = 0;
};
FoundMesh find_mesh(const PointCloud& points);

} // namespace knead::peers

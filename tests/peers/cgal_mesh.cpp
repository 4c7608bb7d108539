#include "peers/cgal_mesh.h"

#include "base/error.h"
#include "base/stopwatch.h"
#include "graph/neighbors.h"
#include "graph/symmetric_graph.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/IO/OFF.h>

#include <algorithm>
#include <fstream>
#include <iterator>

namespace knead::peers {

namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

// Which points hang together by triangles.
Components parts_of(std::size_t points, const std::vector<Triangle>& triangles) {
    std::vector<std::pair<Index, Index>> edges;
    for (const Triangle& triangle : triangles)
        for (const std::size_t c : {0U, 1U, 2U}) edges.emplace_back(triangle[c], triangle[(c + 1) % 3]);
    Graph unlinked;
    unlinked.first.assign(points + 1, 0);
    Workers workers(1);
    return find_components(with_edges(unlinked, edges, workers), workers);
}

} // namespace

std::vector<Triangle> read_triangles(const std::filesystem::path& path) {
    std::ifstream file(path);
    std::vector<Point> points;
    std::vector<std::vector<std::size_t>> faces;
    if (!file || !CGAL::IO::read_OFF(file, points, faces))
        throw Error(Trouble::input, path.string(), "CGAL cannot read it");
    std::vector<Triangle> triangles;
    for (const std::vector<std::size_t>& face : faces) {
        if (face.size() != 3) throw Error(Trouble::input, path.string(), "has faces that are no triangles");
        triangles.push_back(
            {static_cast<Index>(face[0]), static_cast<Index>(face[1]), static_cast<Index>(face[2])});
    }
    return triangles;
}

FoundMesh find_mesh(const PointCloud& points) {
    std::vector<Point> places;
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (!is_finite(points, i)) continue;
        const Vec3d place = points.file_position(i);
        places.emplace_back(place.x(), place.y(), place.z());
    }
    const Stopwatch clock;
    std::vector<std::array<std::size_t, 3>> found;
    CGAL::advancing_front_surface_reconstruction(places.begin(), places.end(), std::back_inserter(found));
    FoundMesh mesh;
    mesh.seconds = clock.seconds();

    for (const auto& corners : found)
        mesh.triangles.push_back(
            {static_cast<Index>(corners[0]), static_cast<Index>(corners[1]), static_cast<Index>(corners[2])});
    const Components parts = parts_of(places.size(), mesh.triangles);
    const auto largest = static_cast<Index>(std::ranges::max_element(parts.size) - parts.size.begin());
    std::vector<Index> number(places.size(), no_index);
    std::vector<float> kept;
    for (std::size_t i = 0; i < places.size(); ++i) {
        if (parts.component[i] != largest) continue;
        number[i] = static_cast<Index>(kept.size() / 3);
        for (int axis = 0; axis < 3; ++axis) kept.push_back(static_cast<float>(places[i][axis]));
    }
    std::erase_if(mesh.triangles, [&](const Triangle& triangle) { return number[triangle[0]] == no_index; });
    for (Triangle& triangle : mesh.triangles)
        for (Index& corner : triangle) corner = number[corner];
    mesh.cloud = make_cloud(kept);
    return mesh;
}

} // namespace knead::peers

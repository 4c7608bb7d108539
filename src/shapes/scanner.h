#pragma once
// A virtual range scanner: looks at a body from several places and returns what a real one would, with range
// noise, grazing surfaces lost, uneven density, holes where no look reaches, and strays.
//
// The body is a signed distance field, found along the rays by sphere tracing (Hart, "Sphere tracing", The
// Visual Computer 12, 1996). Blocks of rays are led to the body together, by a cone that holds them all.

#include "base/progress.h"
#include "base/workers.h"
#include "shapes/point_columns.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace knead {

struct ScannedBody {
    // Signed distance to the surface, negative inside: never more than the true one, and 1-Lipschitz. Called
    // from many threads.
    std::function<double(const Vec3d&)> distance;

    // The colour of a point of the surface.
    std::function<Colour(const Vec3d& place, const Vec3d& normal)> colour;

    Vec3d lowest = Vec3d::Zero(); // a box around all of it
    Vec3d highest = Vec3d::Zero();
};

struct Viewpoint {
    Vec3d eye = Vec3d::Zero(); // outside the body's box; looks at the middle of the box, z up, not along z
    double sharpness = 1;      // rays per angle, relative to the other viewpoints
};

struct ScanOptions {
    std::size_t points = 0; // exactly so many are returned, strays included; ≥ 1
    std::uint64_t seed = 1;
    double noise = 0;        // standard deviation along the ray, a length
    double normal_noise = 0; // standard deviation of the normals, across, in radians
    std::size_t strays = 0;  // < points; up to half fly behind silhouettes, the others anywhere in the air
    double gradient = 1; // ≥ 1: returns from the top of the box are so many times as likely as from its foot
};

// Normals (from the field's gradient; a stray's faces the scanner) and colours are included. The points come
// look after look, row after row from the top, left to right. The rays are 50,000, or so
// many more that they return a few per cent more than the points asked for; the surplus is dropped evenly.
PointCloud scan(const ScannedBody& body, const std::vector<Viewpoint>& viewpoints, const ScanOptions& options,
                Workers& workers, Progress& progress);

// The direction in which the field grows, by differences over a tetrahedron.
Vec3d field_normal(const std::function<double(const Vec3d&)>& distance, const Vec3d& place);

} // namespace knead

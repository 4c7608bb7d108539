#pragma once
// Generated clouds: simple surfaces, a solid, a knot, and a creature that a virtual scanner has seen. They
// are for tests, benchmarks and pictures; a cloud depends on its shape and options alone, byte for byte,
// whatever the number of threads.

#include "base/progress.h"
#include "base/workers.h"
#include "cloud/point_cloud.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace knead {

// What there is, in the cloud's own units (right-handed coordinates). All have normals (nx ny nz, float32,
// unit, outward) but solid_bar, and only the creature has colours (red green blue, uint8). Points of the
// surfaces lie stratified: each in its own cell of equal share, somewhere in the inner four fifths of it, so
// that the sampling is irregular but even, and no two points coincide.
enum class Shape {
    plane, // the unit square 0 ≤ x, y ≤ 1 at z = 0, normals +z; a jittered grid in rows along y; long axis x
    bar,      // the surface of a box 1 × 1 × 5 centred at the origin, long axis z, both end caps included
    cylinder, // a tube without caps, radius 0.5, length 5, around z, -2.5 ≤ z ≤ 2.5
    sphere,   // radius 1 around the origin; long axis z
    torus,    // in the xy plane around z: radius 1 to the tube's middle, tube radius 0.35; long way: the ring
    solid_bar, // the volume of the bar's box, filled evenly; long axis z
    knot,      // a trefoil tube, see knot_spine() and the numbers below; long way: along the tube
    creature,  // a cat that stands on two legs with its arms held out, see below
};

// The knot is a tube around knot_spine(t) = ((2 + 0.6 cos 3t) cos 2t, (2 + 0.6 cos 3t) sin 2t, 0.6 sin 3t),
// 0 ≤ t < 2π, 27.65 long. Where it crosses itself its surfaces come as close as `knot_gap`: 4.8 point
// spacings at 20,000 points, a third of the tube's thickness, a hundredth of its length.
inline constexpr double knot_tube_radius = 0.45;
inline constexpr double knot_gap = 0.3;
Vec3d knot_spine(double t);

struct ShapeOptions {
    std::size_t points = 0; // exactly so many are made, strays included; 1 … 2^32 - 2
    std::uint64_t seed = 1; // another seed, another cloud of the same shape

    // Standard deviation of a gaussian displacement, as a fraction of the mean spacing √(area / points):
    // along the normal on surfaces, along the ray for the creature; in a solid in each of the three
    // coordinates, of ∛(volume / points). 0 … a million; default 0; the creature's 0.3.
    std::optional<double> noise;

    // The fraction of the points that are strays, 0 ≤ outliers < 1, rounded down to whole points. They come
    // last, uniform in the shape's bounding box enlarged by a tenth of its diagonal on every side, with
    // normals of any direction. The creature's (default 0.002) are where scanners have them: see
    // shapes/scanner.h.
    std::optional<double> outliers;

    // Densest over sparsest, ≥ 1, in points per area (volume in a solid). The density grows exponentially
    // along the long axis, from its low end to its high end (the creature: upwards, beside what the scanner
    // makes of it); on the closed ways around torus and knot it is densest at angle (t) 0 and sparsest at π.
    double gradient = 1;
};

// The creature stands on z = 0 with its middle at x = y = 0, faces +x, and has z up; its left is +y. It is
// 1.8 tall and 2 wide from paw to paw.
//   head   middle (0.03, 0, 1.38), about 0.35 in radius; all of z > 1.16 with x > -0.4; ears up to z = 1.8
//   arms   from the shoulders (0, ±0.2, 0.93) to the paws around (0.06, ±0.88, 1.0); all of |y| > 0.45
//   legs   from the hips (0, ±0.16, 0.5) to the feet, 0 ≤ z ≤ 0.15, around (0.06, ±0.19, 0.07); z < 0.33
//   tail   from (-0.2, 0, 0.55) behind the body, then up to its tip (-0.72, 0, 1.22); all of x < -0.36
//   body   the rest, around the z axis, from z = 0.4 to the neck at z = 1.12

// The shape of that name as the command line writes it ("solid-bar"), if there is one.
std::optional<Shape> shape_named(std::string_view name);
std::string_view name_of(Shape shape);

// All names, as "plane, bar, ...", for help and errors.
std::string shape_names();

// Makes the cloud. Columns: x y z, then nx ny nz, then red green blue, those that the shape has. Throws Error
// (usage) in words for the user when an option is out of its range, Cancelled when told so. Takes about 40
// bytes a point, the creature about 60.
PointCloud make_shape(Shape shape, const ShapeOptions& options, Workers& workers, Progress& progress);

} // namespace knead

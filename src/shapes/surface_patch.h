#pragma once
// Surfaces swept by rows, and their even, irregular sampling.

#include "base/progress.h"
#include "base/workers.h"
#include "shapes/point_columns.h"

#include <functional>
#include <vector>

namespace knead {

struct SurfacePoint {
    Vec3d position;
    Vec3d normal; // unit, outward
};

// A surface of rows: u leads from row to row, v runs along one.
struct SurfacePatch {
    double low = 0; // u in low … high
    double high = 1;
    std::function<double(double u)> area;  // of the surface between u and u + du, over du
    std::function<double(double u)> width; // length of the row at u
    std::function<double(double u)>
        density;        // relative, points per area; the same unit for all patches of a shape
    bool closed = true; // rows are rings: where one begins does not matter, and is drawn anew for each

    // The point in the row at u that leaves the fraction v (0 … 1) of the row's area behind it.
    std::function<SurfacePoint(double u, double v)> point;
};

// What is done with the points of a shape.
struct SamplingOptions {
    std::size_t points = 0; // on the surface, strays not counted
    std::uint64_t seed = 1;
    double noise = 0; // standard deviation along the normal, a length
};

// Puts the points 0 … points - 1 into `columns`, patch after patch and row after row: each point has a cell
// of the same mass, as nearly square as can be, and lies anywhere in the inner 80 % of its two sides.
void sample_patches(const std::vector<SurfacePatch>& patches, const SamplingOptions& options,
                    PointColumns& columns, Workers& workers, Progress& progress);

// The place of a point in its cell along one side, in cells: anywhere in the inner 80 %. `random`: 0 … 1.
inline double jittered(double cell, double random) {
    constexpr double share = 0.8;
    return cell + 0.5 + share * (random - 0.5);
}

} // namespace knead

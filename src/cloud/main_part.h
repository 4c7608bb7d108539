#pragma once
// Where a cloud is, whatever a few stray points say.

#include "cloud/point_cloud.h"

#include <cstddef>
#include <limits>

namespace knead {

// The box that holds all but a hundredth of the points at either end of each axis, in the file's coordinates,
// found by some of them. A scanner's stray point, or a "nothing was seen" of 10⁷, must not decide where the
// origin lies: positions are floats about it, and all others would lie on the coarse grid of that one.
struct MainPart {
    Vec3d middle = Vec3d::Zero();
    double size = 0; // the box's diagonal; 0 where it cannot be told: then nothing is far

    // Whether a finite point is so far off that it is none of the cloud's: 10⁴ sizes.
    bool is_far(const Vec3d& p) const {
        const double square = (p - middle).squaredNorm(); // of what is not finite: NaN or infinite
        return size > 0 && square > 1e8 * size * size && square < std::numeric_limits<double>::infinity();
    }
    // Whether a box is so much larger that its middle says nothing of where the cloud is.
    bool is_lost_in(double diagonal) const { return size > 0 && diagonal > 100 * size; }
};

// Of the first `points` of the coordinate columns; `positions` need not be there yet.
MainPart main_part_of(const PointCloud& cloud, std::size_t points);

} // namespace knead

#pragma once
// How every point turned, for points that have a direction beside a normal: Gaussian splats. It is needed
// when a shape is committed or saved, not in a frame.

#include "base/workers.h"
#include "upsample/upsample.h"

#include <span>
#include <vector>

namespace knead {

// The turn of each point: the weighted mean of the turns that its row of influences names, as a unit
// quaternion, after the turn that the point had made before. A point with one influence takes that one, up
// to rounding, and turns are given the sign of the heaviest before they are added, so that a turn of more than 180°
// comes out as it is.
//     input    who moves each point, and how much; normals are not looked at
//     turns    of every motion: unit quaternions, from the rest shape to now
//     before   4n, w x y z: from the shape as opened to the rest shape; or empty, where that is the same
// Returns 4n floats, w x y z: unit quaternions, from the shape as opened to now.
std::vector<float> point_rotations(const UpsampleInput& input, std::span<const Quatd> turns,
                                   std::span<const float> before, Workers& workers);

} // namespace knead

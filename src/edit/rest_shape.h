#pragma once
// The points of a shape, in the order of computation (graph/point_order.h).

#include "base/large_pages.h"

#include <vector>

namespace knead {

// The shape that an edit starts from, or one that handles have posed.
struct RestShape {
    LineArray<float> positions; // 3n, relative to the cloud's origin
    LineArray<float> normals;   // 3n, or empty
    // How each point turned since the cloud was opened: 4n, w x y z. Only committed shapes of clouds of
    // splats have it, see Pipeline::rotations().
    std::vector<float> rotations = {};
};

} // namespace knead

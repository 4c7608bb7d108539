#pragma once
// A generated cloud with everything but its size left at its default.

#include "shapes/shapes.h"

namespace knead {

inline PointCloud made_cloud(Shape shape, std::size_t points, Workers& workers, Progress& progress) {
    ShapeOptions options;
    options.points = points;
    return make_shape(shape, options, workers, progress);
}

} // namespace knead

#pragma once
// What the tests of this room share.

#include "shapes/shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace knead::test {

inline constexpr Shape all_shapes[] = {Shape::plane, Shape::bar,       Shape::cylinder, Shape::sphere,
                                       Shape::torus, Shape::solid_bar, Shape::knot,     Shape::creature};

inline PointCloud made(Shape shape, const ShapeOptions& options, unsigned threads = 2) {
    Workers workers(threads);
    SilentProgress progress;
    return make_shape(shape, options, workers, progress);
}

inline PointCloud made(Shape shape, std::size_t points) {
    ShapeOptions options;
    options.points = points;
    return made(shape, options);
}

inline bool same_values(const PointCloud& a, const PointCloud& b) {
    return std::equal(a.attributes.begin(), a.attributes.end(), b.attributes.begin(), b.attributes.end(),
                      [](const Attribute& one, const Attribute& other) {
                          return one.name == other.name && one.values == other.values;
                      });
}

inline Vec3d normal_of(const std::vector<float>& normals, std::size_t i) {
    return Vec3f(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]).cast<double>();
}

inline std::size_t distinct_positions(const PointCloud& cloud) {
    std::set<std::array<double, 3>> places;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const Vec3d p = cloud.file_position(i);
        places.insert({p.x(), p.y(), p.z()});
    }
    return places.size();
}

} // namespace knead::test

#pragma once
// Samples to deform, without the editor: every point of a small cloud, or some of it, held by a few handles.

#include "deform/sample_system.h"
#include "graph/clouds.h"
#include "graph/edge_weights.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace knead::test {

// The cloud with every point a sample. `handle_at`: which handle holds the point there, or no_index.
inline SampleRest rest_of(const Cloud& cloud, const std::function<Index(const Vec3d&)>& handle_at) {
    SampleRest rest;
    const SampleGraph samples = sample_graph_of_all(cloud.graph);
    rest.graph = samples.graph;
    Vec3d lowest = cloud.at(0);
    Vec3d highest = lowest;
    for (std::size_t v = 0; v < cloud.size(); ++v) {
        rest.position.push_back(cloud.at(v));
        rest.handle.push_back(handle_at(cloud.at(v)));
        lowest = lowest.cwiseMin(cloud.at(v));
        highest = highest.cwiseMax(cloud.at(v));
    }
    rest.cloud_size = (highest - lowest).norm();
    Workers workers(2);
    rest.weight = isotropic_weights(rest.graph, rest.position, samples.contact, of_points, {}, workers);
    return rest;
}

// Handle 0 below `low`, handle 1 above `high`, along z.
inline std::function<Index(const Vec3d&)> both_ends(double low, double high) {
    return [low, high](const Vec3d& p) -> Index { return p.z() < low ? 0 : p.z() > high ? 1 : no_index; };
}

// A bar of 1 × 1 × 5 held at both ends.
inline SampleRest bar(std::size_t points) {
    return rest_of(cloud_of(shape_positions(Shape::bar, points)), both_ends(-2, 2));
}

// p → turn (p - pivot) + pivot + shift. Half the angle goes into the quaternion: it keeps whole turns.
inline HandleMotion motion_about(const Vec3d& axis, double angle, const Vec3d& pivot, const Vec3d& shift) {
    HandleMotion motion;
    const Vec3d imaginary = std::sin(angle / 2) * axis.normalized();
    motion.rotation = Quatd(std::cos(angle / 2), imaginary.x(), imaginary.y(), imaginary.z());
    motion.linear = motion.rotation.toRotationMatrix();
    motion.offset = pivot + shift - motion.linear * pivot;
    return motion;
}

inline constexpr double degrees = std::numbers::pi / 180;

inline Vec3d posed(const SampleSystem& system, const SampleState& state, std::size_t s) {
    return system.rest.position[s] + state.displacement[s];
}

// build_system() with workers of its own.
inline FactorOutcome built(SampleRest rest, SampleSystem& system, unsigned threads = 2) {
    Workers workers(threads);
    return build_system(std::move(rest), system, workers);
}

} // namespace knead::test

#pragma once
// What the tests of view and of the tools look through.

#include "view/camera.h"

#include <gtest/gtest.h>

#include <ostream>

namespace glm {

inline void PrintTo(const dvec3& v, std::ostream* out) {
    *out << '(' << v.x << ", " << v.y << ", " << v.z << ')';
}
inline void PrintTo(const dvec2& v, std::ostream* out) {
    *out << '(' << v.x << ", " << v.y << ')';
}

} // namespace glm

namespace knead::test {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr Viewport screen{800, 600};

// From the given side, the origin in the middle of the screen and `distance` away.
inline Camera camera_from(Side side, double distance = 5) {
    Camera camera;
    look_at_side(camera, side);
    camera.distance = distance;
    return camera;
}

inline ::testing::AssertionResult near(const glm::dvec3& a, const glm::dvec3& b, double tolerance) {
    if (glm::length(a - b) <= tolerance) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << ::testing::PrintToString(a) << " is " << glm::length(a - b)
                                         << " from " << ::testing::PrintToString(b);
}
inline ::testing::AssertionResult near(const glm::dvec2& a, const glm::dvec2& b, double tolerance) {
    return near(glm::dvec3(a, 0.0), glm::dvec3(b, 0.0), tolerance);
}

inline glm::dvec3 right_of(const Camera& camera) {
    return camera.orientation * glm::dvec3(1, 0, 0);
}
inline glm::dvec3 up_of(const Camera& camera) {
    return camera.orientation * glm::dvec3(0, 1, 0);
}
inline glm::dvec3 back_of(const Camera& camera) {
    return camera.orientation * glm::dvec3(0, 0, 1);
}

} // namespace knead::test

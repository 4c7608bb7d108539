#include "view/transform.h"

#include <cmath>

namespace knead {

glm::dvec3 transformed(const Transform& transform, const glm::dvec3& point) {
    glm::dvec3 arm = glm::conjugate(transform.axes) * (point - transform.pivot);
    arm = transform.axes * (transform.scale * arm);
    return transform.pivot + glm::angleAxis(transform.angle, transform.axis) * arm + transform.shift;
}

bool do_the_same(const Transform& a, const Transform& b) {
    const bool turn = a.angle == b.angle && (a.angle == 0 || a.axis == b.axis);
    const bool size = a.scale == b.scale && (a.scale == glm::dvec3(1.0) || a.axes == b.axes);
    return a.pivot == b.pivot && a.shift == b.shift && turn && size;
}

bool does_nothing(const Transform& transform) {
    Transform nothing;
    nothing.pivot = transform.pivot;
    return do_the_same(transform, nothing);
}

double within_turns(double angle) {
    if (!std::isfinite(angle)) return 0;
    if (std::abs(angle) <= most_turned) return angle;
    return std::copysign(most_turned, angle) + std::remainder(angle, 2 * std::numbers::pi);
}

} // namespace knead

#pragma once
// View mathematics speaks GLM, everything else Eigen: from one to the other.

#include "base/types.h"
#include "view/camera.h"

namespace knead {

inline glm::dvec3 to_glm(const Vec3d& v) {
    return {v.x(), v.y(), v.z()};
}
inline glm::dquat to_glm(const Quatd& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}
inline Vec3d to_eigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}
inline Quatd to_eigen(const glm::dquat& q) {
    return {q.w, q.x, q.y, q.z};
}

} // namespace knead

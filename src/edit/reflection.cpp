#include "edit/reflection.h"

#include "edit/view_vectors.h"

namespace knead {

namespace {

Mat3d flip_of(const Reflection& mirror) {
    return Mat3d::Identity() - 2 * mirror.normal * mirror.normal.transpose();
}

// A rotation's axis is axial: it goes by the sense of a turn, which a mirror reverses.
Quatd turn_seen_in(const Mat3d& flip, const Quatd& turn) {
    const Vec3d axis = -(flip * turn.vec());
    return {turn.w(), axis.x(), axis.y(), axis.z()};
}

} // namespace

Reflection reflection(const Vec3d& normal, const Vec3d& here, const Vec3d& there) {
    Reflection mirror{normal.normalized()};
    mirror.place = there - flip_of(mirror) * here;
    return mirror;
}

Vec3d seen_in(const Reflection& mirror, const Vec3d& place) {
    return flip_of(mirror) * place + mirror.place;
}

HandleMotion seen_in(const Reflection& mirror, const HandleMotion& motion) {
    const Mat3d flip = flip_of(mirror);
    HandleMotion result;
    result.linear = flip * motion.linear * flip;
    result.offset = flip * motion.offset + mirror.place - result.linear * mirror.place;
    result.rotation = turn_seen_in(flip, motion.rotation);
    return result;
}

Transform seen_in(const Reflection& mirror, const Transform& transform) {
    const Mat3d flip = flip_of(mirror);
    Transform result = transform;
    result.pivot = to_glm(seen_in(mirror, to_eigen(transform.pivot)));
    result.shift = to_glm(Vec3d(flip * to_eigen(transform.shift)));
    result.axis = to_glm(Vec3d(-(flip * to_eigen(transform.axis))));
    Mat3d axes = flip * to_eigen(transform.axes).toRotationMatrix(); // whose senses do not matter
    axes.col(0) *= -1;
    result.axes = to_glm(Quatd(axes).normalized());
    return result;
}

} // namespace knead

#pragma once
// The pose of a handle as numbers that a hand can read and type.

#include "deform/sample_system.h"
#include "view/transform.h"

namespace knead {

// Of a handle, in this edit; along the axes x, y and z.
struct PoseNumbers {
    Vec3d place = Vec3d::Zero(); // where its pivot is now, relative to the cloud's origin
    Vec3d moved = Vec3d::Zero(); // from where that was at rest
    Vec3d turned =
        Vec3d::Zero(); // degrees about the world's axes, x first: angles_near() (edit/handle_motion.h)
    Vec3d scaled = Vec3d::Ones(); // how much longer it is along each of its own axes than at rest; > 0
};
PoseNumbers numbers_of(const HandleMotion& motion, const Vec3d& pivot);

// The transform that makes one of these numbers another and leaves the others as they are, on top of this
// motion and about the same pivot. (Where y of `turned` is a right angle, x and z are one turn.)
enum class PoseRow { place, moved, turned, scaled };
Transform transform_to(const HandleMotion& motion, const Vec3d& pivot, PoseRow row, int axis, double value);

} // namespace knead

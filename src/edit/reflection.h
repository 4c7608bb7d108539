#pragma once
// What a mirror shows: of a place, of a handle's motion, and of what a hand does.

#include "deform/sample_system.h"
#include "view/transform.h"

namespace knead {

// p → F p + place, with F the reflection across the plane through the origin that `normal` is normal to. It
// is its own way back where `place` lies along the normal: a mirror; else what it shows stands aside, as a
// leg that is set forward does.
struct Reflection {
    Vec3d normal = Vec3d::UnitX(); // unit
    Vec3d place = Vec3d::Zero();
};

// The one across a normal of any length that shows what is `here` to be `there`.
Reflection reflection(const Vec3d& normal, const Vec3d& here, const Vec3d& there);

Vec3d seen_in(const Reflection& mirror, const Vec3d& place);
// M T M⁻¹ for the motion T and the mirror M. How often it turned (`turned`) is left to whoever goes on from
// another motion.
HandleMotion seen_in(const Reflection& mirror, const HandleMotion& motion);
Transform seen_in(const Reflection& mirror, const Transform& transform);

} // namespace knead

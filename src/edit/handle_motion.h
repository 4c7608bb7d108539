#pragma once
// Where the poses of handles send points, and what becomes of them when one drag follows another.

#include "deform/sample_system.h"
#include "edit/session.h"
#include "view/transform.h"

namespace knead {

// Whether it takes a handle's points away from where they were at rest. One that was reset does not, though
// its drags are recorded.
bool leaves_rest(const HandleMotion& motion);

// The angles x, y and z, in radians, of a rotation that turns about the axis x, then y, then z of the world:
// R = R_z(z) R_y(y) R_x(x). Of all that there are, those nearest to `before`: where a handle turns in steps
// of less than half a turn, they count how often it went round. With y at a right angle, where x and z turn
// about the same axis, x stays as it was.
Vec3d angles_near(const Quatd& rotation, const Vec3d& before);

// The motion p → pivot + R S (p - pivot) + translate about the cloud's origin. It goes on from `before`, that
// of the frame before (at rest at first): of the two quaternions of the turn it has the one of the same
// hemisphere, which keeps turns beyond 360° (at exactly 90° between them, as written); and `turned` are the
// angles nearest to those before. A handle that is put back to rest has turned by none.
HandleMotion motion_of(const HandlePose& pose, const Vec3d& pivot, const Vec3d& origin,
                       const HandleMotion& before);

// The pose about `pivot` that motion_of() turns into this motion again (up to rounding): the way back, for
// poses that were put together from several drags. Throws Error (usage) if the motion mirrors or flattens,
// which no pose does.
HandlePose pose_of(const HandleMotion& motion, const Vec3d& pivot, const Vec3d& origin);

// `change` after `motion`. The rotation continues that of `motion`, and so do its angles, by as many whole
// turns as the change has.
HandleMotion followed_by(const HandleMotion& motion, const Transform& change);

} // namespace knead

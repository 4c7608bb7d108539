#pragma once
// Where the poses of handles send points, and what becomes of them when one drag follows another.

#include "deform/sample_system.h"
#include "edit/session.h"
#include "view/transform.h"

#include <numbers>

namespace knead {

// Whether it takes a handle's points away from where they were at rest. One that was reset does not, though
// its drags are recorded.
bool leaves_rest(const HandleMotion& motion);
// Whether it takes nothing away and is wound up by nothing either: after one turn of 360° every point is
// where it was, but the quaternion is the negative one, and what is between two handles is twisted. (After
// 720° it is the positive one again, and nobody can tell.)
bool is_at_rest(const HandleMotion& motion);

// Where a motion takes a point, and where a point was at rest that the motion has taken to `point`.
Vec3d moved_point(const HandleMotion& motion, const Vec3d& point);
Vec3d point_at_rest(const HandleMotion& motion, const Vec3d& point);
// Where a place on a handle goes when the handle leaves one motion for another.
Vec3d moved_on(const Vec3d& place, const HandleMotion& before, const HandleMotion& after);

// The same, with its points exactly where they were at rest if that is where they are but for rounding; how
// it is wound up stays. `reach`: how large what its offset was made of is.
HandleMotion without_rounding(HandleMotion motion, double reach);

// The angles x, y and z, in radians, of a rotation that turns about the axis x, then y, then z of the world:
// R = R_z(z) R_y(y) R_x(x). Of all that there are, those nearest to `before`. With y at a right angle, where
// x and z turn about the same axis, x stays as it was.
Vec3d angles_near(const Quatd& rotation, const Vec3d& before);

// The rotation at part t of the way between two quaternions of which each has its own sign, told apart from
// its negative.
Quatd between(const Quatd& from, const Quatd& to, double t);

// The angles at the end of the way from one rotation to another, between quaternions of which each has its
// own sign: less than a whole turn. They go on from `angles`, those of `from`, without a leap, so that from
// step to step they count how often it went round.
Vec3d angles_along(const Quatd& from, const Vec3d& angles, const Quatd& to);

// The motion p → pivot + R S (p - pivot) + translate about the cloud's origin. It goes on from `before`, that
// of the frame before (at rest at first): of the two quaternions of the turn it has the one of the same
// hemisphere, which keeps turns beyond 360° (at exactly 90° between them, as written); and its angles go on
// from those before. A handle that is put back to rest has turned by none.
HandleMotion motion_of(const HandlePose& pose, const Vec3d& pivot, const Vec3d& origin,
                       const HandleMotion& before);

// The pose about `pivot` that motion_of() turns into this motion again (up to rounding): the way back, for
// poses that were put together from several drags. Throws Error (usage) if the motion mirrors or flattens,
// which no pose does.
HandlePose pose_of(const HandleMotion& motion, const Vec3d& pivot, const Vec3d& origin);

// `change` after `motion`. The rotation continues that of `motion`, and so do its angles where the change is
// less than a whole turn.
HandleMotion followed_by(const HandleMotion& motion, const Transform& change);

// A handle that no hand drags turns by no more than this from frame to frame, in radians: so nothing is lost
// of what the samples between it and the others turn, however many turns there are.
inline constexpr double widest_turn = 20.0 * std::numbers::pi / 180.0;

// Where a handle is that goes along with another: what takes that one from `from` to `to` takes this one from
// `motion`. Its rotation and its angles go on from `before`, that of the frame before.
HandleMotion gone_along(const HandleMotion& motion, const HandleMotion& from, const HandleMotion& to,
                        const HandleMotion& before);

// The transform of the next frame on the way from what is shown to what is wanted: the wanted one, but for
// the angle, which goes on by no more than a frame may turn. So a typed "720" winds up like one that was
// dragged. Where the axis is another one, what was turned about the old one is unwound first, unless one
// frame may turn as far as from the one to the other.
Transform next_on_the_way(const Transform& shown, const Transform& wanted);

// A handle that a transform carries off, step by step as the document's frames do: so its angles count the
// turns as theirs do. What is no pose, since something in it is no number, carries it nowhere.
struct CarriedMotion {
    HandleMotion base;    // when it began
    HandleMotion now;     // by `shown`, after `base`
    Transform shown = {}; // so far
};
void carry_on(CarriedMotion& carried, const Transform& wanted);

} // namespace knead

#pragma once
// The pose of a handle as numbers that a hand can read and type.

#include "deform/sample_system.h"
#include "view/transform.h"

#include <vector>

namespace knead {

// Of a handle, in this edit; along, or about, the axes x, y and z.
struct PoseNumbers {
    Vec3d place = Vec3d::Zero();  // where its pivot is now, relative to the cloud's origin
    Vec3d moved = Vec3d::Zero();  // from where that was at rest
    Vec3d turned = Vec3d::Zero(); // in degrees about the world's axes, x first; HandleMotion::turned
    Vec3d scaled = Vec3d::Ones(); // how much longer it is along each of its own axes than at rest; > 0
    bool is_sheared = false;      // it was scaled along others: these factors are not all of that
};
PoseNumbers numbers_of(const HandleMotion& motion, const Vec3d& pivot);

// Whether these angles, as HandleMotion::turned has them, make the same rotation with the same whole turns:
// they are equal, or y is a right angle, where x and z are one turn.
bool are_one_turn(const Vec3d& some, const Vec3d& others);

enum class PoseRow { place, moved, turned, scaled };
double number_in(const PoseNumbers& numbers, PoseRow row, int axis); // axis: 0 x, 1 y, 2 z

// The transform that makes one of these numbers another, on top of this motion and about the same pivot; a
// factor has to be > 0. The others stay as they are, but for these: a place and a way are one and the same;
// where y of `turned` is a right angle, x and z are one turn; and what was scaled along other axes than its
// own turns a little with a factor.
Transform transform_to(const HandleMotion& motion, const Vec3d& pivot, PoseRow row, int axis, double value);

// The ones that take all of a move or of a scaling back, sheared or not, and leave the rest as it is.
Transform unmoved(const HandleMotion& motion, const Vec3d& pivot);
Transform unscaled(const HandleMotion& motion, const Vec3d& pivot);

// The same of a turn, about `pivot`, which stays where it is: every frame of unwinding it, whole turns too,
// by no more than `widest_turn` each, the last one without any turn. None where it has not turned.
std::vector<HandleMotion> unturned(const HandleMotion& motion, const Vec3d& pivot);

} // namespace knead

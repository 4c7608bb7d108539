#pragma once
// Which way up a cloud is meant to be seen.

#include "base/types.h"
#include "view/camera.h"

#include <optional>
#include <span>

namespace knead {

// The axis along which the cloud stands: what a floor, a base or feet spread out at the low end of it. Files
// do not say; surveys have z upwards, most models y. Told by the lowest 3 % along either axis: by the share
// that their convex hull, seen from above, has of that of all points. The larger share is of the axis if it
// is a fifth at least and half as much again as the other. Where neither is that large and the highest 3 %
// along y have half of it, y points down. Else nothing can be told. Coordinates of a survey, in metres east
// and north of somewhere far away, have z upwards whatever the ground is like. `positions`: 3n floats,
// finite, in any order; some 25,000 to 50,000 of more are looked at; `origin`: of the cloud, which they are
// relative to.
std::optional<UpAxis> standing_axis(std::span<const float> positions, const Vec3d& origin);

} // namespace knead

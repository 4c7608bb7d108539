#pragma once
// The way of a handle back to where it was at rest, and to where another one is. Private to this room.

#include "edit/handle_motion.h"

#include <span>

namespace knead {

// Whether a handle that went this way is at rest and nothing is left to unwind. `way`: as below, or none.
bool is_back(std::span<const HandleMotion> way);

// A drag that takes the handle back to rest the way it came, so that what was wound up is unwound: what it
// has gone back already is not gone again, and small detours are cut short; whole turns are not. `way`: its
// motions in this edit, the first one first; the last frame is the identity. `middle`: of the handle at rest;
// it goes straight from corner to corner. Scaling goes off evenly on the way.
DragLine way_back(const std::string& handle, std::span<const HandleMotion> way, const Vec3d& middle,
                  const Vec3d& origin);

// A drag from rest to where the way ends, by the same stops: a handle that another's way is given to is wound
// up as often. `way`: at least one motion.
DragLine way_there(const std::string& handle, std::span<const HandleMotion> way, const Vec3d& middle,
                   const Vec3d& origin);

} // namespace knead

#pragma once
// Joints of handles as a document keeps them. Private to this room.

#include "edit/document.h"

#include <memory>
#include <optional>
#include <span>
#include <string>

namespace knead {

// The same with another place for this handle's, or with none. Null where there are none at all, before or
// after.
std::shared_ptr<const Pivots> with_pivot(const std::shared_ptr<const Pivots>& pivots,
                                         const std::string& handle, const std::optional<Vec3d>& place);

// Where a commit leaves them: where their handles took them. `motions`: one a handle, about the cloud's
// origin, in whose coordinates the pivots are not.
std::shared_ptr<const Pivots> carried(const std::shared_ptr<const Pivots>& pivots,
                                      std::span<const Handle> handles, std::span<const HandleMotion> motions,
                                      const Vec3d& origin);

} // namespace knead

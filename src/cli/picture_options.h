#pragma once
// What the options of a picture mean.

#include "base/types.h"
#include "cli/pictures.h"
#include "view/camera.h"

namespace knead {

// All throw Error (usage) that names the option.

// "1280x800": 1 … `largest` each.
Viewport parse_size(const std::string& text, int largest);

// "z", "y" or "-y"; "auto": standing_axis() of `positions` about `origin`, z where nothing can be told.
UpAxis parse_up(const std::string& text, std::span<const float> positions, const Vec3d& origin);

// "front" … "bottom" with respect to the upward axis, or degrees "azimuth,elevation": 0,0 is the front; a
// larger azimuth goes round to the right, a larger elevation up. Empty: a pleasant first view. Framed on the
// bulk of `positions` (3n floats); upright as `opened`, the same as they were before they were posed, stands
// (both about `origin`).
Camera camera_for(const PictureOptions& options, std::span<const float> positions,
                  std::span<const float> opened, const Vec3d& origin, Viewport viewport);

ColorBy parse_color(const std::string& text);

glm::vec3 parse_background(const std::string& text); // "#rrggbb"

} // namespace knead

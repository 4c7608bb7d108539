#pragma once
// Places inside of what is seen: where an artist points to put a joint.

#include "base/workers.h"
#include "view/camera.h"

#include <cstdint>
#include <optional>
#include <span>

namespace knead {

// The middle of the first limb that a line of sight meets, on that line: half way from its surface to the
// next one behind, or to where the points end that fill it; on the surface where nothing lies behind. Nothing
// where the line meets nothing. `positions`: 3n floats; `hidden`: n bytes, points that do not count; or
// empty; `spacing`: the usual distance of neighbouring points. What lies closer together than three spacings
// is one surface, as registered scans are that overlap. `from_afar`: what lies behind the ray's origin counts
// as well, as in an orthographic view.
std::optional<glm::dvec3> middle_along(const Ray& ray, bool from_afar, std::span<const float> positions,
                                       std::span<const std::uint8_t> hidden, double spacing,
                                       Workers& workers);

} // namespace knead

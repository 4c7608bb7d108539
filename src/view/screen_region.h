#pragma once
// Which points of the cloud a click, box, lasso, polygon or brush means.

#include "base/types.h"
#include "base/workers.h"
#include "view/camera.h"

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace knead {

struct ScreenBox {
    glm::dvec2 corner{0.0}, opposite{0.0}; // any two opposite ones
};
struct ScreenPolygon {
    std::vector<glm::dvec2> corners; // closed by itself; inside by the even-odd rule; fewer than 3: empty
};
// A brush stroke: all that lies within `radius` of the path.
struct ScreenStroke {
    std::vector<glm::dvec2> path;
    double radius = 0;
};
using ScreenRegion = std::variant<ScreenBox, ScreenPolygon, ScreenStroke>;

// The edge of a box and of a stroke belongs to it. Nothing lies in a region with a corner that is not finite.
bool contains(const ScreenRegion& region, glm::dvec2 pixel);

// Sets inside[i] to 1 for every point whose projection lies in the region and in front of the eye, and to 0
// for the others. `positions`: 3n floats; `hidden`: n bytes, hidden points are never inside; or empty.
void points_in_region(const Camera& camera, Viewport viewport, std::span<const float> positions,
                      std::span<const std::uint8_t> hidden, const ScreenRegion& region,
                      std::span<std::uint8_t> inside, Workers& workers);

// The visible point that a click at `pixel` means: the nearest to the eye of those within `radius` pixels, of
// equals the first; no_index where there is none.
Index point_under(const Camera& camera, Viewport viewport, std::span<const float> positions,
                  std::span<const std::uint8_t> hidden, glm::dvec2 pixel, double radius, Workers& workers);

} // namespace knead

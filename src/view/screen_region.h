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

// The nearest surface seen in every cell of a coarse grid over the viewport: what decides which points are
// visible without asking the graphics card, and the same on every machine.
struct VisibleSurface {
    int columns = 0, rows = 0;
    double cell = 1;          // pixels
    double tolerance = 0;     // how far behind a level surface one is still seen, in the cloud's units
    std::vector<float> depth; // of each cell; infinity where nothing is seen
    std::vector<float> limit; // the farthest depth that is still seen there, more where the surface is steep
};
// `spacing`: the usual distance of neighbouring points. Cells are three spacings wide as seen on the nearer
// parts of the cloud (at least 2 pixels), so that a surface closes and hides what is behind; along
// silhouettes the verdict is as coarse as they are.
VisibleSurface visible_surface(const Camera& camera, Viewport viewport, std::span<const float> positions,
                               std::span<const std::uint8_t> hidden, double spacing, Workers& workers);
// Clears inside[i] of the points that the surface hides, and of those outside the viewport.
void keep_visible(const Camera& camera, Viewport viewport, std::span<const float> positions,
                  const VisibleSurface& surface, std::span<std::uint8_t> inside, Workers& workers);

// The visible point that a click at `pixel` means: the nearest to the eye of those within `radius` pixels, of
// equals the first; no_index where there is none.
Index point_under(const Camera& camera, Viewport viewport, std::span<const float> positions,
                  std::span<const std::uint8_t> hidden, glm::dvec2 pixel, double radius, Workers& workers);

} // namespace knead

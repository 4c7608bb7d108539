#pragma once
// Which points of the cloud are seen, and not behind others.

#include "base/workers.h"
#include "view/camera.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

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

} // namespace knead

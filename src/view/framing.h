#pragma once
// What of a cloud to look at, and how far its points lie apart: what a camera and the size of splats are
// chosen by.

#include "view/camera.h"

#include <span>

namespace knead {

// The box around the bulk of the points: a few stray ones do not make it large. Along every axis it leaves
// out the 0.2 % of the points at either end where they lie far from the rest, and none where the cloud just
// ends there. `positions`: 3n floats, finite, in any order; of none, the unit box.
Box3 bulk_box(std::span<const float> positions);

// As frame() of bulk_box(), but of a box along the camera's own axes, which holds the points more tightly.
void frame_points(Camera& camera, std::span<const float> positions, Viewport viewport);

// The usual distance between neighbouring points, told from about two thousand of them: what three in
// four have their fifth nearest point within, among those next in memory; a little wide rather than narrow.
// `positions`: 3n floats, finite, in an order that keeps neighbours together. Positive, whatever the points
// are.
double usual_spacing(std::span<const float> positions);

} // namespace knead

#pragma once
// The gizmo on the chosen handle: arrows, planes, rings, a screen ring and scale boxes, of constant size on
// the screen. Mathematics only: what it looks like is a list of polylines in pixels that the window draws.

#include "view/transform_drag.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace knead {

struct GizmoPart {
    TransformKind kind = TransformKind::translate;
    Constraint constraint;
    bool operator==(const GizmoPart&) const = default;
};

// In parts of `size` from the centre: rings at 0.7, arrows from 0.15 to 1, planes at 0.22 … 0.4 between two
// arrows, scale boxes at 1.14 beyond the arrows (alone: at 1), the screen ring at 1.3, and about the centre a
// small disc that shifts freely (alone with scale: scales evenly).
struct Gizmo {
    glm::dvec3 center{0.0};
    glm::dquat axes{1, 0, 0, 0}; // world: identity; local: the handle's
    bool local = false;
    double size = 90;                                   // of an arrow, in pixels
    bool translate = true, rotate = true, scale = true; // which parts are shown
};

// Whether such a transform would change anything of what the gizmo is on.
bool has_effect(const Gizmo& gizmo, TransformKind kind);

// A part as it is drawn: a polyline in pixels, filled where it is closed and says so. An arrow is two shapes,
// its shaft and its head; so is a ring, its near half and its far one.
struct GizmoShape {
    GizmoPart part;
    std::vector<glm::dvec2> outline; // filled ones are convex
    bool filled = false;
    bool closed = false;
    int color_axis = 0; // 0 red x, 1 green y, 2 blue z, 3 white (screen); of a plane that of its normal
    double depth = 0;
    bool behind = false; // the half of a ring that faces away, or one that is seen as a line: drawn faint
};

// In the order in which to draw them: rings first, which seen from their sides lie on arrows, then what is
// farther from the eye. Nothing when the centre is behind the eye. Parts seen end-on are left out, since they
// could not be dragged.
std::vector<GizmoShape> gizmo_shapes(const Gizmo& gizmo, const Camera& camera, Viewport viewport);

// The part under the cursor, within so many pixels; the nearest to the eye wins, arrows and boxes before
// rings, which go round much and lie in the way of other things.
struct GizmoReach {
    double rings = 8, others = 8;
};
std::optional<GizmoPart> gizmo_part_under(const Gizmo& gizmo, const Camera& camera, Viewport viewport,
                                          glm::dvec2 cursor, GizmoReach reach = {});

} // namespace knead

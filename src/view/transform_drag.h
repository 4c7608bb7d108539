#pragma once
// A transform in the making: what the cursor, the keys X, Y, Z and typed numbers (view/typed_amount.h) make
// of a handle while a hand holds it.

#include "view/camera.h"
#include "view/transform.h"

#include <array>
#include <string>

namespace knead {

enum class TransformKind { translate, rotate, scale };

// Along, about or across what.
struct Constraint {
    enum class Kind {
        free,
        axis,
        plane
    } kind = Kind::free; // free: in the plane of the screen,
                         // or by typed lengths along all three axes
    int axis = 0;        // 0 x, 1 y, 2 z; of a plane, its normal
    bool local = false;  // the handle's own axes instead of the world's

    bool operator==(const Constraint&) const = default;
};

// A transform in the making, begun at a cursor and driven by the cursor or by a typed number. Blender's G, R
// and S; a gizmo's part begins the same with its constraint set.
//
// Shifting, the pivot follows the cursor as nearly as the constraint lets it: to the point of the axis
// nearest to what the cursor points at, or where that meets the plane. Turning, the angle is the cursor's
// about the pivot on the screen, or its way across an axis that lies in the screen. Scaling, the factor is
// the cursor's distance from the pivot on the screen over what it was at the start.
//
// The camera may move while the drag goes on: what was reached stays, and the next motion goes on from it.
struct TransformDrag {
    TransformKind kind = TransformKind::translate;
    Constraint constraint;
    glm::dvec3 pivot{0.0};
    glm::dquat local_axes{1, 0, 0, 0}; // of the handle when the drag began
    glm::dvec2 start{0.0};             // where the cursor was
    glm::dvec2 cursor{0.0};            // where it is now (with Shift's slowness taken out)
    double turned = 0;                 // radians followed so far about the axis, whole turns included
    // "45", "-1.5"; of a shift one number for each axis that the constraint leaves, of a scaling as well once
    // Tab was pressed, else the first alone. All empty: the cursor drives.
    std::array<std::string, 3> typed;
    int field = 0;          // which of them is typed at
    bool each_axis = false; // of a scaling: a factor for each axis that is left, and not one for all
    bool own_first = false; // X, Y, Z ask for the handle's own axis before the world's
    bool snap = false;      // whole steps: 5° in rotation, a tenth in scale, `grid` in translation
    double grid = 0;        // a round length that suits the view

    glm::dvec2 hand{0.0};                  // where the cursor is in truth
    glm::dvec3 screen_axis{0.0, 0.0, 1.0}; // towards the eye when the drag began: free rotation's axis
    Camera camera;                         // that `start` and `cursor` belong to
    Viewport viewport;
    glm::dvec3 shift_before{0.0}; // reached before the camera moved last
    double factor_before = 1;

    bool operator==(const TransformDrag&) const = default;
};
TransformDrag begin_transform(TransformKind kind, const glm::dvec3& pivot, const glm::dquat& local_axes,
                              glm::dvec2 cursor, const Camera& camera, Viewport viewport);
// Follows the cursor; a tenth of its way when `slow`. Call it for every motion: rotation counts its turns.
void follow_cursor(TransformDrag& drag, glm::dvec2 cursor, bool slow, const Camera& camera,
                   Viewport viewport);
// The cursor went there for another reason, such as orbiting in mid-drag: the transform stays as it is, and
// goes on from there under this camera.
void hold_transform(TransformDrag& drag, glm::dvec2 cursor, const Camera& camera, Viewport viewport);
// The key X, Y or Z (axis 0, 1, 2): first press the world's axis, second the handle's own (the other way
// round where `own_first`), third free again; with `plane` (Shift) the plane across it.
void press_axis(TransformDrag& drag, int axis, bool plane);
// The transform as it stands, by what the drag has followed: nothing moves or flips with the camera.
Transform transform_of(const TransformDrag& drag);

} // namespace knead

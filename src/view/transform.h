#pragma once
// What a hand does to a handle in one drag: a rotation by any number of turns, a scaling and a shift, about a
// pivot.

#include "view/camera.h"

#include <array>
#include <numbers>
#include <optional>
#include <string>

namespace knead {

// p → pivot + Q S (p - pivot) + shift, with Q the rotation by `angle` about `axis` and S the scaling along
// `axes`. It comes on top of the pose that the handle had when the drag began.
struct Transform {
    glm::dvec3 pivot{0.0};
    glm::dvec3 shift{0.0};
    glm::dvec3 axis{0.0, 0.0, 1.0}; // unit
    double angle = 0;               // radians; 4π is two whole turns, not none
    glm::dvec3 scale{1.0};          // along `axes`
    glm::dquat axes{1, 0, 0, 0};

    bool operator==(const Transform&) const = default;
};

glm::dvec3 transformed(const Transform& transform, const glm::dvec3& point);
// Whether two do the same, or one does nothing: they may be written in more than one way.
bool do_the_same(const Transform& a, const Transform& b);
bool does_nothing(const Transform& transform);

// By less a handle is not scaled: to nothing, or inside out.
inline constexpr double least_factor = 0.01;

// At once a handle turns by no more than this, in radians: twenty turns.
inline constexpr double most_turned = 40 * std::numbers::pi;
// Beyond that a typed angle keeps its remainder alone: nobody means the others. 0 for one that is not finite.
double within_turns(double angle);

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
// A character of a number: digits, '.' or ',', '-' (turns the sign round); '\b' takes the last back. Others
// are not taken: returns false. Degrees in rotation, a factor in scale; in translation a length along the
// axis, and first along x where it is free, along the first of a plane's two axes.
bool type_character(TransformDrag& drag, char character);
// The key Tab: the next of these lengths, or the one before; what is typed at that becomes it. Likewise of
// factors, of which there is one for each axis from there on. What is held to one axis, and has its number
// typed, is free then, with that number for that axis. Nothing of a rotation.
void next_field(TransformDrag& drag, bool back);
// The transform as it stands, by what the drag has followed: nothing moves or flips with the camera.
Transform transform_of(const TransformDrag& drag);
// What is done, for beside the cursor: the key, the amount, what it is held to; what was typed stands in
// brackets. "R  45.0°", "G  X 1.250  along world X", "S  × [1.3]  in own YZ",
// "S  ×  X 1.50  Y [2]  Z 1.00".
std::string amount_text(const TransformDrag& drag);

} // namespace knead

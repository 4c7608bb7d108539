#pragma once
// From the hand's input to commands: the camera, the five ways to select, the gizmo, and the modal G, R, S.
//
// A tool knows no document and no window. It gets the input, what it needs to know of the present state, and
// appends commands. Carry them out before the next input: its context is to know their effect.
//
// Camera. Middle drag orbits, Shift+middle pans, Ctrl+middle zooms, the wheel zooms to the cursor;
//   Alt+left is a middle button. All of it also works in the middle of a transform, which stays as it is
//   meanwhile. 1/3/7 front, right, top (Ctrl: the opposite), 5 orthographic, F frames the selection, Home
//   all.
// Choosing. A press and release without motion chooses the handle under the cursor, or the point, or what is
//   in the brush's circle, with every tool but the polygon's, whose clicks add corners (double click, Enter
//   or right click closes, Backspace or Ctrl+Z takes the last back). Shift adds, Ctrl takes away; strokes of
//   the brush add by themselves. Esc or right click drops a band, and so does Ctrl+Z any but a polygon. One
//   SelectRegion a gesture. A double click sets the camera's pivot. A all, Alt+A none (Esc too), Ctrl+I
//   invert, Ctrl+plus/minus grow and shrink, L connected, V hides (Shift: the others, Alt: shows all). Tools:
//   C click, B box, Q lasso, P polygon, K brush, [ ] (as Characters) its size, T through.
// Handles. H makes a moving one, Shift+H a fixed one, Ctrl+H the region of interest. Where the pivot is moved
//   (move_pivot), a click puts it inside of the limb there, with the polygon as well, and Esc ends that
//   first.
// Moving. A press on the gizmo drags its part until the release, but with Shift, by which a selection that
//   begins there is added: a slow drag instead would hardly be seen. G, R, S follow the hand until a click
//   or Enter. X, Y, Z constrain (press_axis() in view/transform_drag.h), Ctrl snaps, Shift slows, digits and
//   . - + * / arrive as Characters, Tab goes to the next length. Esc, Ctrl+Z or right click cancels; another
//   of G, R, S goes on as that. R and S of what they would not change are refused, and all three without a
//   gizmo; an amount that is typed on then means nothing. No other key is taken in a drag, which is
//   BeginDrag, DragTo whenever the transform changed, and EndDrag; or CancelDrag, also where it ends with
//   nothing moved.
// Enter commits the pose; Ctrl+Z undoes, Ctrl+Shift+Z and Ctrl+Y redo.

#include "edit/command.h"
#include "edit/input.h"
#include "view/gizmo.h"

#include <optional>
#include <vector>

namespace knead {

enum class SelectTool { click, box, lasso, polygon, brush };

// What the tools may look at.
struct ToolContext {
    Camera camera;
    Viewport viewport;
    std::optional<Gizmo> gizmo;        // of the chosen moving handle, if there is one that can be dragged
    glm::dquat local_axes{1, 0, 0, 0}; // that handle's own
};

// What the hand is doing. Plain state, changed by handle_input() alone; the window reads it to draw the
// rubber band, the gizmo's highlight and the amount beside the cursor.
struct Tools {
    SelectTool select = SelectTool::lasso; // drop_everything() before it is changed from outside
    bool through = false;
    Orbiting orbiting = Orbiting::turntable;
    double brush_radius = 24; // pixels, changed by [ and ]
    bool move_pivot = false;  // the gizmo's arrows and G move the pivot instead of the handle

    enum class Doing { nothing, orbiting, panning, selecting, transforming, zooming } doing = Doing::nothing;
    glm::dvec2 cursor{0.0}, pressed{0.0};
    // Of the selection in the making: the path of lasso and brush, the clicked corners of a polygon (the next
    // is to be at the cursor), for a box where it began (its other corner is at the cursor).
    std::vector<glm::dvec2> band;
    SelectMode band_mode = SelectMode::replace;
    std::optional<GizmoPart> hovered;  // the gizmo's part under the cursor
    std::optional<TransformDrag> drag; // of the chosen handle
    bool modal = false;                // the drag was begun by G, R or S: a click confirms, not a release
    bool orbiting_in_drag = false;     // the camera moves while a drag goes on

    MouseButton button =
        MouseButton::left;              // whose release ends what is being done; of the camera's in a drag
    Doing camera_move = Doing::nothing; // while the camera moves: orbiting, panning or zooming
    bool moved = false;                 // the hand has left the place of the press
    int clicks = 1;                     // of that press
    Transform sent;                     // the last transform that DragTo told
    bool drags_pivot = false;           // the drag moves the gizmo's pivot
    // G, R or S was refused, just now or with an amount typed on since, which is taken for nothing else.
    enum class Refused : std::uint8_t { no, just_now, typed_on } refused = Refused::no;
};

// Handles one input; commands go to the end of `commands` in the order in which they are to be applied.
// Returns whether the input was used (if not, it may be a menu's key).
// Keys that need what is not there are not; but G, R and S with no gizmo are refused with words.
bool handle_input(Tools& tools, const ToolContext& context, const Input& input,
                  std::vector<Command>& commands);

// Drops whatever is going on: a drag is cancelled.
void drop_everything(Tools& tools, std::vector<Command>& commands);

} // namespace knead

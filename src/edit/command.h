#pragma once
// Everything that the editor can be told to do. Tools, menus, keys and panels only make commands; apply() in
// edit/editor.h carries them out. A Command is plain data.

#include "edit/select_mode.h"
#include "edit/session.h"
#include "view/screen_region.h"
#include "view/transform_drag.h"

#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace knead {

// --- Choosing points ---

struct SelectRegion {
    ScreenRegion region;
    SelectMode mode = SelectMode::replace;
    bool through = false; // also what lies behind the visible surface
};
struct SelectPointUnder { // a click
    glm::dvec2 pixel{0.0};
    SelectMode mode = SelectMode::replace;
    double radius = 0;    // in pixels, of the brush: all in that circle instead of the point
    bool through = false; // as of a region, then
};
enum class SelectionStep { all, none, invert, grow, shrink, connected, outliers };
struct ChangeSelection {
    SelectionStep step = SelectionStep::none;
};
struct SelectHandlePoints {
    std::string handle;
    SelectMode mode = SelectMode::replace;
};
struct DropChoice {}; // selects nothing; or, where nothing is selected, chooses no handle
enum class HideStep { hide_selected, hide_unselected, show_all };
struct ChangeHidden {
    HideStep step = HideStep::show_all;
};

// --- Handles ---

struct MakeHandle { // of the selection; an empty name: the next free one
    HandleRole role = HandleRole::moving;
    std::string name;
};
struct ChooseHandle {
    std::string handle; // empty: none
};
struct ChooseAlso { // it goes along when the chosen one is moved; or does no longer
    std::string handle;
};
struct MirrorMoves { // what is moved moves its counterpart across this axis, too; nothing: nothing does
    std::optional<int> axis; // 0 x, 1 y, 2 z
};
struct RenameHandle {
    std::string handle, to;
};
struct AssignPoints { // the selection: instead of the handle's points, beside them, or taken from them
    std::string handle;
    SelectMode mode = SelectMode::replace;
};
struct ChangeRole {
    std::string handle;
    HandleRole role = HandleRole::moving;
};
struct ChangeHold { // how a fixed or moving handle holds
    std::string handle;
    bool free_rotation = false;
    double falloff = 0; // a length, ≥ 0
};
struct ColorHandle {
    std::string handle;
    std::optional<std::uint32_t> color; // 0xrrggbb; nothing: the usual one
};
struct DeleteHandles {
    std::vector<std::string> handles;
};
struct ResetPoses { // of those that move
    std::vector<std::string> handles;
};
enum class PosePart { move, turn, scaling };
struct TakeBackPart { // of the poses of those that move; the rest of each stays
    std::vector<std::string> handles;
    PosePart part = PosePart::move;
};
// The points on the other side of the cloud become a handle as this one is, with its pose mirrored; where a
// moving one holds these already, that one takes the pose of a moving one.
struct MirrorHandle {
    std::string handle;
    int axis = 1; // the normal of the plane through the middle of the cloud: 0 x, 1 y, 2 z
};

// --- Poses ---

struct BeginDrag { // of the chosen handle, and of those that go along
    glm::dvec3 pivot{0.0};
};
struct DragTo {
    Transform transform; // on top of the pose at BeginDrag
};
struct EndDrag {};
struct CancelDrag {};    // the pose at BeginDrag again
struct RefuseTransform { // a key asked for one that cannot be, or would change nothing; the user hears why
    TransformKind kind = TransformKind::rotate;
};
struct SetPivot { // of the chosen handle's gizmo; nothing: the handle's middle
    std::optional<glm::dvec3> pivot;
    // The hand is still moving it; or has given up, and it is where it was.
    enum class Stage { set, moving, given_up } stage = Stage::set;
};
struct SetPivotInside { // a click: into the middle of the limb under the cursor
    glm::dvec2 pixel{0.0};
};
struct SetPivotToSelection {}; // the middle of the points that are selected

// --- The document ---

struct ChangeSettings {
    SettingsChange change;
};
struct ChooseSamples { // by themselves (edit/sample_choice.h), or as many as there are now
    bool by_itself = false;
};
struct CommitPose {};
struct UndoStep {
    bool to_look = false; // what comes after is not to be lost by an act
};
struct RedoStep {
    bool to_look = false; // going back from there leads to what was recorded before
};
struct PlayStep {};   // redoes it, picture by picture
struct PacePlaying {  // of the step that is being played, and of later ones
    double speed = 1; // 1: 30 of the recorded frames a second
    bool held = false;
};
struct AdvancePlaying { // while it is held
    int frames = 1;     // below 0: back, as far as the drag goes
};

// --- The camera ---

struct MoveCamera {
    Camera camera;
};
enum class FrameWhat { selection, everything };
struct FrameView {
    FrameWhat what = FrameWhat::everything;
};
struct LookAtSide {
    Side side = Side::front;
};
struct SetPivotUnder { // a double click: the point under the cursor becomes the camera's pivot
    glm::dvec2 pixel{0.0};
};

using Command =
    std::variant<SelectRegion, SelectPointUnder, ChangeSelection, SelectHandlePoints, DropChoice,
                 ChangeHidden, MakeHandle, ChooseHandle, ChooseAlso, MirrorMoves, RenameHandle, AssignPoints,
                 ChangeRole, ChangeHold, ColorHandle, DeleteHandles, ResetPoses, TakeBackPart, MirrorHandle,
                 BeginDrag, DragTo, EndDrag, CancelDrag, RefuseTransform, SetPivot, SetPivotInside,
                 SetPivotToSelection, ChangeSettings, ChooseSamples, CommitPose, UndoStep, RedoStep, PlayStep,
                 PacePlaying, AdvancePlaying, MoveCamera, FrameView, LookAtSide, SetPivotUnder>;

} // namespace knead

#pragma once
// What the files of the editor share: steps of undo, words for the user, and the acts on handles. Private to
// this room.

#include "edit/editor.h"
#include "edit/view_vectors.h"

#include <functional>
#include <span>

namespace knead {

void say(Editor& editor, Notice::Kind kind, std::string words);

// A copy of the marks of selection and hiding, to go back to; that of the last step where it is the same.
std::shared_ptr<const KeptMarks> snapshot(const Editor& editor);

// A step as it will stand on the history, which has room for it then. `document`: the step of the document
// that is to be posted, which can fail, between this and add_step(), which cannot; 0: none. `before`: the
// marks before it, if it changed them.
EditorStep coming_step(Editor& editor, StepNumber document,
                       std::shared_ptr<const KeptMarks> before = nullptr);

// Puts the step that was coming on the history; what could be redone is forgotten, by a step of the document
// as soon as that has carried it out.
void add_step(Editor& editor, EditorStep step) noexcept;

// Posts lines as one step of undo; returns its number.
StepNumber post_step(Editor& editor, std::vector<SessionAction> lines,
                     std::shared_ptr<const KeptMarks> marks_before = nullptr);

// Of the document's handle of this name, as far as the document is known; nothing: it has none.
std::optional<std::size_t> number_of(const Editor& editor, const std::string& name);

// Whether no handle has this name, of the document's and of those that are on their way there.
bool is_free(const Editor& editor, const std::string& name);

// Whether the document will have a handle of this name once it has carried out what was posted.
bool will_be_there(const Editor& editor, const std::string& name);

// Another handle is chosen, or none; with the step done last, if that made it or is to bring it back.
void choose(Editor& editor, const std::string& handle);
void choose_with_step(Editor& editor, const std::string& handle);

// A handle's pivot, and no step of it; nothing: its middle.
void put_pivot(Editor& editor, const std::string& handle, const std::optional<glm::dvec3>& pivot);
// The same, as part of a step that moves the handle, names or deletes it.
void put_pivot_with(EditorStep& step, Editor& editor, const std::string& handle,
                    const std::optional<glm::dvec3>& pivot);
// Pivots as they were before a step.
void take_pivots_back(Editor& editor, const EditorStep& step);

// Whether the number of samples is chosen by itself from here on; no step of its own.
void choose_samples(Editor& editor, bool by_itself);

// Selection and hiding as in `from`; the bits of the handles stay.
void restore_selection(Editor& editor, const KeptMarks& from);

// Counts again what is selected and tells the renderer.
void marks_changed(Editor& editor);

// Changes the marks as one step of undo; no step where nothing changed.
void change_marks(Editor& editor, const std::function<void()>& change);

// The number of the handle that each point follows, in the order of the edit, or no_index. Of what several
// hold the last one has it; regions take nothing from others.
std::vector<Index> followed_handles(const Editor& editor);

// The bits that say which handle a point belongs to, from the document's handles.
void mark_handles(Editor& editor);

// The hidden bits as bytes of their own; empty where nothing is hidden.
std::vector<std::uint8_t> hidden_points(const Editor& editor);

// A click means what is so near to it, in pixels.
inline constexpr double click_radius = 8;

// The point that a click on the picture means, in the order of the edit, as it is now; no_index: none.
Index point_clicked(Editor& editor, glm::dvec2 pixel);
// Takes the newest step back, which is one of selection alone, as if it had never been.
void forget_last_selection(Editor& editor);

// How a tool selects a part: "draw a lasso round".
std::string way_to_select(SelectTool tool);

// Whether steps were posted that the document has not carried out yet, a drag under way among them.
bool has_pending_steps(const Editor& editor);

// Whether a document is open; tells the user if not.
bool needs_document(Editor& editor);

// Whether something may be added to what was done: not while another file is being opened, nor while an
// earlier step is looked at. Tells the user why not.
bool may_act(Editor& editor);

// Whether an act may go on from the pose that is shown: not in the middle of a step that is played, from
// whose end it would. Tells the user why not.
bool may_go_on_from_pose(Editor& editor);

// What the newest drag that moves a handle, be it along with another one, has made of it, where the document
// has not answered it yet.
struct UnansweredMove {
    const CarriedMotion& motion;
    glm::dvec3 middle; // of its gizmo, by now
};
std::optional<UnansweredMove> unanswered_move(const Editor& editor, const std::string& handle);
// Where the gizmo of a handle stands, or would if it were chosen.
glm::dvec3 place_of_gizmo(const Editor& editor, const Handle& handle);
// What the hand does to one that goes along.
Transform transform_of(const EditorDrag& drag, const EditorDrag::Along& along);

// Where the points are in this edit while no handle is moved: 3n, in the order of computation.
std::span<const float> rest_positions(const Editor& editor);
// The middle of a handle's points in a shape, as above; nothing for one without a finite point.
std::optional<Vec3d> middle_in(std::span<const float> positions, const Editor& editor, const Handle& handle);

// Looks for the counterparts of what is chosen, after another is chosen or the handles have changed.
void find_counterparts(Editor& editor);
// Where the joint of a chosen handle's counterpart is when that of the handle is at `pivot`, both as they are
// now; none: there is no counterpart.
struct JointAcross {
    std::string handle;
    glm::dvec3 pivot{0.0};
};
std::optional<JointAcross> joint_across(const Editor& editor, const std::string& handle,
                                        const glm::dvec3& pivot);
// The handles that go along in a drag of the chosen handle about `pivot`.
std::vector<EditorDrag::Along> handles_along(const Editor& editor, const glm::dvec3& pivot);

// One that is none any more.
void forget_drag(Editor& editor, StepNumber step);

void carry_out(Editor& editor, const SelectRegion& command);
void carry_out(Editor& editor, const SelectPointUnder& command);
void carry_out(Editor& editor, const ChangeSelection& command);
void carry_out(Editor& editor, const ChangeHidden& command);
void carry_out(Editor& editor, const UndoStep& command);
void carry_out(Editor& editor, const RedoStep& command);
void carry_out(Editor& editor, const PlayStep& command);
void carry_out(Editor& editor, const PacePlaying& command);
void carry_out(Editor& editor, const AdvancePlaying& command);
void carry_out(Editor& editor, const MakeHandle& command);
void carry_out(Editor& editor, const ChooseHandle& command);
void carry_out(Editor& editor, const ChooseAlso& command);
void carry_out(Editor& editor, const MirrorMoves& command);
void carry_out(Editor& editor, const RenameHandle& command);
void carry_out(Editor& editor, const AssignPoints& command);
void carry_out(Editor& editor, const ChangeRole& command);
void carry_out(Editor& editor, const ChangeHold& command);
void carry_out(Editor& editor, const ColorHandle& command);
void carry_out(Editor& editor, const DeleteHandles& command);
void carry_out(Editor& editor, const ResetPoses& command);
void carry_out(Editor& editor, const TakeBackPart& command);
void carry_out(Editor& editor, const MirrorHandle& command);
void carry_out(Editor& editor, const SelectHandlePoints& command);
void carry_out(Editor& editor, const DropChoice& command);
void carry_out(Editor& editor, const BeginDrag& command);
void carry_out(Editor& editor, const DragTo& command);
void carry_out(Editor& editor, const EndDrag& command);
void carry_out(Editor& editor, const CancelDrag& command);
void carry_out(Editor& editor, const RefuseTransform& command);
void carry_out(Editor& editor, const SetPivot& command);
void carry_out(Editor& editor, const SetPivotInside& command);
void carry_out(Editor& editor, const SetPivotToSelection& command);

} // namespace knead

#pragma once
// The editor without its window: what is open, what is selected, how it is looked at, and what every command
// does to that.
//
// One way round a frame: Input → tools → Commands → apply(editor, command) → refresh(editor) takes in what
// the live document has newly made → `changes` says what a renderer has to upload. Nothing here waits, but
// where a document goes, because another takes its place: until its thread has heard of that.

#include "base/workers.h"
#include "edit/command.h"
#include "edit/handle_motion.h"
#include "edit/kept_marks.h"
#include "edit/live_document.h"
#include "edit/reflection.h"
#include "edit/selecting.h"
#include "edit/tools.h"

#include <chrono>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace knead {

// What happened since a renderer last looked; it clears what it has dealt with.
struct EditorChanges {
    bool cloud = true;     // another cloud: everything
    bool positions = true; // editor.frame
    bool marks = true;
};

// The number of all steps of a session that was opened; those of the hand come after it.
inline constexpr StepNumber step_of_opened_session = 1;

// Where a handle's pivot was, and where it is; nothing: in the handle's middle.
struct PivotMove {
    std::string handle;
    std::optional<glm::dvec3> before = {}, after = {};
};

// One step of undo: a change of selection and hiding, a step of the document, or both; or of a pivot.
struct EditorStep {
    StepNumber document = 0; // 0: none
    std::shared_ptr<const KeptMarks> before =
        {}; // marks of selection and hiding, of a step that changed them; else null
    std::shared_ptr<const KeptMarks> after = {};
    // Of settings: when they were changed last. Those that change within a second join it.
    std::optional<std::chrono::steady_clock::time_point> settings_changed = {};
    StepNumber joined = 0; // the newest line of it
    // Whether the number of samples was chosen by itself before and after; nothing: it stays as it is.
    std::optional<bool> choosing_before = {}, choosing_after = {};
    // The chosen handle before and after a step of the document; nothing: it stays as it is.
    std::optional<std::string> chosen_before = {}, chosen_after = {};
    bool is_drag = false;               // whose pose is known before the document has it (EditorDrag)
    std::vector<PivotMove> pivots = {}; // that it moved, or that went with their handles
    // What could be redone before it, until the document has carried it out: it may be refused, or cancelled.
    std::vector<EditorStep> undone = {};
};

// A drag that goes on, or that ended and that the document has not answered yet.
struct EditorDrag {
    StepNumber step = 0;
    std::string handle;
    glm::dvec3 middle{0.0}; // of the gizmo when it began
    CarriedMotion motion;   // of the handle, from then to now
    struct Along {
        std::string handle;
        glm::dvec3 middle{0.0}; // likewise
        CarriedMotion motion;
        std::optional<Reflection> mirror = {}; // in which it goes along
    };
    std::vector<Along> along; // others that it takes along
    Transform transform;      // so far
    bool ended = false;
};

// Moves are made on both sides of the cloud. Which handle lies across from which goes by the shape as it was
// opened: no pose parts two of them.
struct Symmetry {
    int axis = 0;  // 0, 1, 2: across x, y, z
    double at = 0; // along it, relative to the cloud's origin: where the plane lies
    struct Pair {
        std::string handle, counterpart;
    };
    std::vector<Pair> pairs; // of what is chosen, what has a counterpart: that goes along, mirrored
};

// What goes with the document that is open, and is as it is here when another takes its place.
struct EditorOfDocument {
    // --- Choosing ---
    std::vector<std::uint8_t> marks; // of each point
    std::size_t selected = 0;        // points
    std::size_t hidden = 0;
    std::vector<std::size_t>
        followers;      // of each handle: the points that it moves, or holds; not what others took
    std::string chosen; // the handle with the gizmo, once the document has it; empty: none
    std::vector<std::string> also_chosen;     // moving ones that go along when that is moved
    std::optional<Symmetry> symmetry;         // nothing: what is moved moves alone
    std::map<std::string, glm::dvec3> pivots; // of the gizmo, by handle, where the user moved them
    std::optional<PivotMove> moved_pivot;     // that the hand is moving

    // --- Dragging ---
    std::optional<EditorDrag> drag;        // the newest; nothing: it has been answered, or there was none
    std::vector<EditorDrag> earlier_drags; // that ended before it and are not answered either
    glm::dvec3 handle_middle{0.0};         // of the chosen handle's points as they are now

    // --- Going back ---
    std::vector<EditorStep> past, future;
    // How many steps were done where looking at others (UndoStep::to_look) began; nothing: nobody looks.
    std::optional<std::size_t> looks_from;
    // Names of handles that were posted and that the document has not shown yet.
    std::vector<std::pair<StepNumber, std::string>> posted_names;
    // And names that it will not have any more: of handles that were renamed or deleted.
    std::vector<std::pair<StepNumber, std::string>> names_to_go;
    std::string just_made; // a handle, after which nothing was done or chosen; empty: none
    // What was just taken back, done again or deleted, in a sentence, until something else is told; or empty.
    std::string just_done;
    // Where a click made the newest step, and nothing was told since; nothing: it was something else.
    std::optional<glm::dvec2> just_clicked;
};

struct Editor : EditorOfDocument {
    explicit Editor(unsigned threads = 0) : workers(threads) {}

    Workers workers; // of the window's thread; the live document has its own

    // --- What is open ---
    std::unique_ptr<LiveDocument> live;    // null: nothing
    std::unique_ptr<LiveDocument> opening; // takes the place of `live` once it is open
    OpenRequest opening_request;
    // What could not be opened for want of its session's cloud, and why; the window takes it.
    struct WithoutCloud {
        OpenRequest request;
        std::string why;
    };
    std::optional<WithoutCloud> without_cloud;
    OpenedCloud opened;
    std::shared_ptr<const DocumentView> document; // null: nothing is open
    PosedFrame frame;                             // the points as they are now
    LiveDocument::Status status;                  // of `live`, or of `opening` while there is one
    bool saving = false; // a file of `live` is being written; what comes of it is among the notices then
    bool chooses_samples = false; // by itself, as the document was told last
    std::vector<Index> ordered;   // of each point of the file: its place in the order; no_index: left out
    StepNumber last_step = step_of_opened_session;

    // --- Looking ---
    Camera camera;
    Viewport viewport;
    Tools tools;
    bool local_axes = false; // the gizmo's

    // --- Telling ---
    std::uint64_t marks_version = 0; // counts the changes of `marks`, of one document after the other
    std::vector<Notice> notices;     // for the user, oldest first; the window takes them
    std::vector<HeldSave>
        held_saves; // that the user is to be asked about, one after the other; the window takes them
    EditorChanges changes;
};

// Starts opening a cloud or a session beside what is open.
void open(Editor& editor, OpenRequest request);
void cancel_opening(Editor& editor);

// Carries out a command. What cannot be done is said in editor.notices, with what to do about it.
void apply(Editor& editor, const Command& command);

// Takes in what the live document has made since; call it once a frame. Returns whether anything changed.
bool refresh(Editor& editor);

// Write the shape as it is, or the session so far, as LiveDocument does; until they are done, `saving`.
void save_cloud(Editor& editor, std::filesystem::path target, ExportOptions options, bool anyway,
                bool keeps_original = false);
void save_session(Editor& editor, std::filesystem::path target, bool anyway);

// Feeds one input of the hand to the tools and applies what they say. Returns whether it was used.
bool handle_input(Editor& editor, const Input& input);

// Takes another of the tools that select; what the hand was doing is dropped.
void take_select_tool(Editor& editor, SelectTool tool);

// --- What follows from the state ---

Box3 box_of(const Editor& editor); // of all points as they are now, relative to the cloud's origin
std::optional<Box3> box_of_selection(const Editor& editor); // nothing when nothing is selected
std::optional<Box3> box_of_chosen(const Editor& editor);    // nothing when no handle is chosen
const Handle* chosen_handle(const Editor& editor);          // null: none
// Those that are chosen together, if this is one of them: it first. Else it alone.
std::vector<std::string> chosen_with(const Editor& editor, const std::string& handle);
// The same, and the counterparts that go along with them, mirrored.
std::vector<std::string> moved_with(const Editor& editor, const std::string& handle);
// Whether it goes along with what is chosen as its counterpart, mirrored.
bool goes_mirrored(const Editor& editor, const std::string& handle);
// Which one a name is for that is asked for now: the one that was just made, whatever is chosen. Null: none,
// or the document has yet to make it.
const Handle* handle_to_name(const Editor& editor);
// The middle of a handle's points as they are now; nothing for one without a finite point.
std::optional<glm::dvec3> middle_of(const Editor& editor, const Handle& handle);
std::optional<Gizmo> gizmo_of(const Editor& editor); // of the chosen moving handle, where it is now
// Where the user put a handle's pivot, as it is now; nothing: it is the handle's middle.
std::optional<glm::dvec3> pivot_of(const Editor& editor, const std::string& handle);
// The pose of the chosen moving handle, and where its pivot is: as they are, or as the drag that goes on
// wants them. Nothing where none is chosen.
struct ChosenPose {
    HandleMotion motion;
    glm::dvec3 pivot{0.0};
};
std::optional<ChosenPose> pose_of_chosen(const Editor& editor);
// Of a handle of the document, by its number: as it is, or as a drag wants it that is not answered yet.
HandleMotion motion_now(const Editor& editor, std::size_t handle);
// Whether the document is posed, or will be when it has answered all drags.
bool is_or_will_be_posed(const Editor& editor);
// Whether poses may be others by the time that the document has done what it was told: it takes something
// back, resets or commits; or a step is being played.
bool poses_may_change(const Editor& editor);
// Whether handles may not stay where the window shows them: the document was told to take something back, to
// make, reset or commit something, and has not answered, or the window has yet to show what it answered. What
// is moved then begins elsewhere than where the hand sees it, and about another pivot.
bool handles_may_be_elsewhere(const Editor& editor);
// What is small or thin of a handle of the document. Empty until it is prepared.
std::vector<const SmallPatch*> small_patches(const Editor& editor, const Handle& handle);
// How far that pulls what is around it at the most, whatever the handle's own falloff is; 0 where nothing
// does.
double least_falloff(const Editor& editor, const Handle& handle);
// Of one of the document's: how many points follow it, those not that later handles hold, too.
std::size_t followers_of(const Editor& editor, const Handle& handle);
bool has_unsaved_session(const Editor& editor);               // an exported cloud is no saved session
std::string free_name(const Editor& editor, HandleRole role); // for the next handle: "handle 2"
bool looks_back(const Editor& editor); // whether a step before where looking began is shown
bool can_undo(const Editor& editor);
bool can_redo(const Editor& editor);
// What these would do, in a few words such as "head" moves; empty where nobody knows yet.
std::string words_of_undo(const Editor& editor);
std::string words_of_redo(const Editor& editor);
// The handle whose point is seen there, in pixels; empty: none.
std::string handle_under(Editor& editor, glm::dvec2 pixel);
// What to do next, in a sentence, for the line at the bottom; empty when the artist is well under way.
std::string next_step(const Editor& editor);
// The displacement of every point from the opened shape, in the cloud's units, ordered.
std::vector<float> displacements(Editor& editor);
// The mean ratio of the lengths of a point's links now to those when opened; empty until the graph is built.
std::vector<float> local_stretch(Editor& editor);

} // namespace knead

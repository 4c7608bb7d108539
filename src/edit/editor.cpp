#include "edit/editor.h"

#include "base/error.h"
#include "edit/cures.h"
#include "edit/editor_steps.h"
#include "edit/tool_steps.h"
#include "view/framing.h"

#include <algorithm>
#include <utility>

namespace knead {

void say(Editor& editor, Notice::Kind kind, std::string words) {
    editor.notices.push_back({.kind = kind, .words = std::move(words)});
}

bool needs_document(Editor& editor) {
    if (editor.document) return true;
    say(editor, Notice::Kind::information, "Open a cloud first: Ctrl+O, or drop a file on the window.");
    return false;
}

namespace {

// --- The document ----------------------------------------------------------------------------------------

// Settings that change so soon after one another are one movement of a slider.
constexpr std::chrono::seconds one_gesture{1};

// A slider that goes on being moved is one step. A number of samples of the user's own ends the choosing, and
// taking it back takes that back.
void carry_out(Editor& editor, const ChangeSettings& command) {
    if (!needs_document(editor)) return;
    const bool ends_choosing = command.change.samples && editor.chooses_samples;
    if (ends_choosing) choose_samples(editor, false);
    const auto now = std::chrono::steady_clock::now();
    const auto goes_on = [&](const EditorStep& step) {
        return step.settings_changed && now - *step.settings_changed < one_gesture;
    };
    if (!editor.past.empty() && editor.future.empty() && goes_on(editor.past.back()))
        editor.live->post(++editor.last_step, {SetLine{command.change}}, true);
    else
        post_step(editor, {SetLine{command.change}});
    EditorStep& step = editor.past.back();
    step.joined = editor.last_step;
    step.settings_changed = now;
    if (!ends_choosing) return;
    if (!step.choosing_before) step.choosing_before = true;
    step.choosing_after = false;
}

void carry_out(Editor& editor, const ChooseSamples& command) {
    if (!needs_document(editor) || command.by_itself == editor.chooses_samples) return;
    choose_samples(editor, command.by_itself);
    const SampleChoice& suited = editor.document->suited;
    const bool changes = command.by_itself && suited.samples != editor.document->settings.samples;
    if (!changes || is_or_will_be_posed(editor)) return; // the document does, when it can
    SettingsChange change;
    change.samples = suited.samples;
    post_step(editor, {SetLine{change}});
    editor.past.back().choosing_before = false;
    editor.past.back().choosing_after = true;
}

void carry_out(Editor& editor, const CommitPose& /*command*/) {
    if (!needs_document(editor) || (editor.drag && !editor.drag->ended)) return;
    if (!is_or_will_be_posed(editor))
        return say(editor, Notice::Kind::information, "Nothing is posed, so there is nothing to commit.");
    post_step(editor, {CommitLine{}});
    editor.just_done =
        "The pose is the new rest shape now, and the numbers of its handles begin anew; Ctrl+Z "
        "takes it back";
}

// --- The camera ------------------------------------------------------------------------------------------

constexpr double least_framed = 8; // spacings of the points, to each side

void carry_out(Editor& editor, const MoveCamera& command) {
    editor.camera = command.camera;
}

void carry_out(Editor& editor, const FrameView& command) {
    if (!editor.document) return;
    std::optional<Box3> box;
    if (command.what == FrameWhat::selection) box = box_of_selection(editor);
    if (command.what == FrameWhat::selection && !box) box = box_of_chosen(editor);
    if (box) { // a point, or a few, with what is around them
        const glm::dvec3 middle = (box->lowest + box->highest) / 2.0,
                         least(least_framed * editor.opened.spacing);
        box->lowest = glm::min(box->lowest, middle - least);
        box->highest = glm::max(box->highest, middle + least);
    }
    frame(editor.camera, box ? *box : bulk_box(editor.frame.positions()), editor.viewport);
}

void carry_out(Editor& editor, const LookAtSide& command) {
    look_at_side(editor.camera, command.side);
}

void carry_out(Editor& editor, const SetPivotUnder& command) {
    if (!editor.document) return;
    const Index hit = point_clicked(editor, command.pixel);
    if (hit == no_index) return;
    const float* p = editor.frame.positions().data() + 3 * std::size_t{hit};
    set_pivot(editor.camera, {p[0], p[1], p[2]});
    const auto first_click = std::exchange(editor.just_clicked, std::nullopt);
    constexpr double farthest = 3 * click_radius; // between two clicks, on a screen of whatever resolution
    if (first_click && glm::distance(*first_click, command.pixel) <= farthest) forget_last_selection(editor);
}

// --- Looking back ----------------------------------------------------------------------------------------

template<typename One, typename... Others>
bool is_one_of(const Command& command) {
    return std::holds_alternative<One>(command) || (std::holds_alternative<Others>(command) || ...);
}

// Whether it would add a step, after which those that come later are gone.
bool is_act(const Command& command) {
    return is_one_of<SelectRegion, SelectPointUnder, ChangeSelection, SelectHandlePoints, ChangeHidden,
                     MakeHandle, RenameHandle, AssignPoints, ChangeRole, ChangeHold, ColorHandle,
                     DeleteHandles, ResetPoses, TakeBackPart, MirrorHandle, BeginDrag, SetPivot,
                     SetPivotInside, SetPivotToSelection, ChangeSettings, ChooseSamples, CommitPose>(command);
}

// Whether it goes on from the pose as it is, or makes it the rest shape, or may.
bool goes_on_from_pose(const Command& command) {
    return is_one_of<MakeHandle, AssignPoints, ChangeRole, ChangeHold, DeleteHandles, ResetPoses,
                     TakeBackPart, MirrorHandle, BeginDrag, SetPivot, SetPivotInside, SetPivotToSelection,
                     ChangeSettings, CommitPose>(command);
}

// Whether it only looks at what is there.
bool only_looks(const Command& command) {
    return is_one_of<MoveCamera, FrameView, LookAtSide, MirrorMoves>(command);
}

void decline(Editor& editor, const char* words) {
    std::vector<Command> unheard;
    if (editor.tools.drag) cancel_drag(editor.tools, unheard);
    say(editor, Notice::Kind::information, words);
}

} // namespace

bool may_act(Editor& editor) {
    // Whoever opens another file was asked what becomes of this one, as it was then.
    if (editor.opening && editor.live) {
        decline(editor,
                "Another file is being opened and takes the place of this one: what you do here now would "
                "be lost. Wait for it, or cancel it.");
        return false;
    }
    if (looks_back(editor)) {
        decline(editor,
                "This is an earlier step, and what was done later would be lost. Esc goes back to where you "
                "were; Ctrl+Z undoes to here, to go on from this one.");
        return false;
    }
    return true;
}

bool may_go_on_from_pose(Editor& editor) {
    if (editor.status.playing)
        decline(editor,
                "This is the middle of a step, and what you do here would go on from its end. Play on to "
                "there first (Space, or Right frame by frame).");
    return !editor.status.playing;
}

void apply(Editor& editor, const Command& command) {
    try {
        if (is_act(command) && !may_act(editor)) return;
        if (goes_on_from_pose(command) && !may_go_on_from_pose(editor)) return;
        if (!only_looks(command)) {
            editor.just_done.clear();
            if (!is_one_of<SetPivotUnder>(command)) editor.just_clicked.reset();
        }
        std::visit([&](const auto& c) { carry_out(editor, c); }, command);
    } catch (const std::exception&) {
        say(editor, Notice::Kind::error, words_about_exception());
    }
}

void save_cloud(Editor& editor, std::filesystem::path target, ExportOptions options, bool anyway,
                bool keeps_original) {
    editor.live->save_cloud(std::move(target), options, anyway, keeps_original,
                            options.without_hidden ? hidden_points(editor) : std::vector<std::uint8_t>{});
    editor.saving = true;
}

void save_session(Editor& editor, std::filesystem::path target, bool anyway) {
    editor.live->save_session(std::move(target), anyway);
    editor.saving = true;
}

void take_select_tool(Editor& editor, SelectTool tool) {
    std::vector<Command> commands;
    drop_everything(editor.tools, commands);
    for (const Command& command : commands) apply(editor, command);
    editor.tools.select = tool;
}

bool handle_input(Editor& editor, const Input& input) {
    ToolContext context;
    context.camera = editor.camera;
    context.viewport = editor.viewport;
    context.gizmo = gizmo_of(editor);
    if (editor.drag && !editor.drag->ended)
        context.local_axes = to_glm(editor.drag->motion.base.rotation);
    else if (const auto pose = pose_of_chosen(editor))
        context.local_axes = to_glm(pose->motion.rotation);
    std::vector<Command> commands;
    const bool used = handle_input(editor.tools, context, input, commands);
    for (const Command& command : commands) apply(editor, command);
    return used;
}

} // namespace knead

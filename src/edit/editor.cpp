#include "edit/editor.h"

#include "base/error.h"
#include "edit/cures.h"
#include "edit/editor_steps.h"
#include "edit/tool_steps.h"
#include "view/framing.h"

#include <algorithm>
#include <new>
#include <utility>

namespace knead {

glm::dvec3 to_glm(const Vec3d& v) {
    return {v.x(), v.y(), v.z()};
}

glm::dquat to_glm(const Quatd& q) {
    return {q.w(), q.x(), q.y(), q.z()};
}

Vec3d to_eigen(const glm::dvec3& v) {
    return {v.x, v.y, v.z};
}

void say(Editor& editor, Notice::Kind kind, std::string words) {
    editor.notices.push_back({.kind = kind, .words = std::move(words)});
}

bool needs_document(Editor& editor) {
    if (editor.document) return true;
    say(editor, Notice::Kind::information, "Open a cloud first: Ctrl+O, or drop a file on the window.");
    return false;
}

// --- Opening ---------------------------------------------------------------------------------------------

void open(Editor& editor, OpenRequest request) {
    editor.opening_request = request;
    editor.opening = std::make_unique<LiveDocument>(std::move(request));
}

void cancel_opening(Editor& editor) {
    if (editor.opening) editor.opening->cancel_opening();
}

namespace {

// What was opened takes the place of what was there, of which nothing is to be restored: whoever opens a file
// was asked about it.
void take_over(Editor& editor) {
    if (editor.live) editor.live->discard_journal();
    editor.live = std::move(editor.opening);
    editor.opened = editor.live->opened();
    editor.document = editor.live->view();
    editor.chooses_samples = editor.document->chooses_samples;
    editor.frame = {};
    editor.live->take_frame(editor.frame);
    editor.drag.reset();
    editor.chosen.clear();
    editor.posted_names.clear();
    editor.pivots.clear();
    editor.moved_pivot.reset();
    editor.tools.drag.reset();
    editor.tools.doing = Tools::Doing::nothing;

    editor.ordered.assign(editor.opened.cloud->size(), no_index);
    const std::vector<Index>& file_index = editor.opened.order->file_index;
    for (Index i = 0; i < file_index.size(); ++i) editor.ordered[file_index[i]] = i;
    editor.marks.assign(file_index.size(), 0);
    editor.past.assign(editor.document->undoable_steps, EditorStep{step_of_opened_session});
    editor.future.assign(editor.document->redoable_steps, EditorStep{step_of_opened_session});
    editor.looks_from.reset();
    mark_handles(editor);
    editor.camera = first_view(bulk_box(editor.frame.positions), editor.viewport);
    editor.changes = {};
}

// What is open has to finish that before another takes its place.
bool is_still_saving(const Editor& editor) {
    return editor.live && editor.live->status().saving;
}

bool refresh_opening(Editor& editor) {
    if (!editor.opening) return false;
    const LiveDocument::Status status = editor.opening->status();
    if (status.stage == LiveDocument::Stage::opening) return false;
    if (status.stage == LiveDocument::Stage::open && is_still_saving(editor)) return false;
    std::vector<Notice> notices = editor.opening->take_notices();
    if (status.wants_cloud && !notices.empty()) {
        editor.without_cloud = {editor.opening_request, std::move(notices.back().words)};
        notices.pop_back();
    }
    std::ranges::move(notices, std::back_inserter(editor.notices));
    if (status.stage == LiveDocument::Stage::open)
        take_over(editor);
    else
        editor.opening.reset();
    return true;
}

// The next step of the future is its last.
void forget_future(Editor& editor, StepNumber step) {
    const auto found = std::ranges::find(editor.future, step, &EditorStep::document);
    if (found == editor.future.end()) return;
    const auto at = editor.past.size() + static_cast<std::size_t>(editor.future.end() - found) - 1;
    editor.future.erase(found);
    if (editor.looks_from && at < *editor.looks_from) --*editor.looks_from;
}

// A step that the document refused is no step: it leaves the history, and the selection comes back.
void forget_refused(Editor& editor) {
    for (const StepNumber step : editor.live->take_refused()) {
        std::erase_if(editor.posted_names, [&](const auto& posted) { return posted.first == step; });
        forget_future(editor, step);
        for (EditorStep& past : editor.past)
            if (past.joined == step) past.joined = 0;
        if (editor.drag && editor.drag->step == step) editor.drag.reset();
        const auto found = std::ranges::find(editor.past, step, &EditorStep::document);
        if (found == editor.past.end()) continue;
        if (found->before) restore_selection(editor, *found->before);
        if (found->chosen_before && found->chosen_after == editor.chosen)
            choose(editor, *found->chosen_before);
        if (found->choosing_before) choose_samples(editor, *found->choosing_before);
        take_pivots_back(editor, *found);
        const auto at = static_cast<std::size_t>(found - editor.past.begin());
        editor.past.erase(found);
        if (editor.looks_from && at < *editor.looks_from) --*editor.looks_from;
    }
}

bool refresh_view(Editor& editor) {
    auto view = editor.live->view();
    if (view == editor.document) return false;
    const bool other_handles = !hold_the_same(view->handles, editor.document->handles);
    editor.document = std::move(view);
    if (other_handles) mark_handles(editor);
    std::erase_if(editor.posted_names,
                  [&](const auto& posted) { return posted.first <= editor.document->last_step; });
    if (editor.drag && editor.drag->ended && editor.document->last_step >= editor.drag->step)
        editor.drag.reset();
    return true;
}

} // namespace

bool refresh(Editor& editor) {
    bool changed = refresh_opening(editor);
    if (editor.opening) editor.status = editor.opening->status();
    if (!editor.live) return changed;
    const auto playing = editor.status.playing;
    if (!editor.opening) editor.status = editor.live->status();
    editor.saving = editor.live->status().saving; // before its words are taken
    changed |= playing != editor.status.playing;
    forget_refused(editor);
    changed |= refresh_view(editor);
    editor.saved = editor.live->saved();
    if (editor.live->take_frame(editor.frame)) {
        editor.changes.positions = true;
        changed = true;
    }
    if (changed && !editor.drag)
        if (const Handle* handle = chosen_handle(editor))
            editor.handle_middle = middle_of(editor, *handle).value_or(glm::dvec3(0.0));
    for (Notice& notice : editor.live->take_notices()) {
        editor.notices.push_back(std::move(notice));
        changed = true;
    }
    for (HeldSave& held : editor.live->take_held_saves()) {
        editor.held_saves.push_back(std::move(held));
        changed = true;
    }
    return changed;
}

namespace {

// --- Selecting -------------------------------------------------------------------------------------------

// Changes the marks as one step of undo; no step where nothing changed.
template<typename Change>
void change_marks(Editor& editor, Change&& change) {
    auto before = snapshot(editor);
    std::forward<Change>(change)();
    if (*before == *snapshot(editor)) return;
    marks_changed(editor);
    add_step(editor, 0, std::move(before));
}

// The hidden bits as bytes of their own; empty where nothing is hidden.
std::vector<std::uint8_t> hidden_points(const Editor& editor) {
    std::vector<std::uint8_t> hidden;
    if (editor.hidden == 0) return hidden;
    hidden.resize(editor.marks.size());
    std::ranges::transform(editor.marks, hidden.begin(),
                           [](std::uint8_t mark) { return (mark & mark_hidden) ? 1 : 0; });
    return hidden;
}

// Settings that change so soon after one another are one movement of a slider.
constexpr std::chrono::seconds one_gesture{1};

constexpr double click_radius = 8; // pixels
constexpr double least_framed = 8; // spacings of the points, to each side

void carry_out(Editor& editor, const SelectRegion& command) {
    if (!needs_document(editor)) return;
    std::vector<std::uint8_t> inside(editor.marks.size());
    const std::vector<std::uint8_t> hidden = hidden_points(editor);
    points_in_region(editor.camera, editor.viewport, editor.frame.positions, hidden, command.region, inside,
                     editor.workers);
    if (!command.through) {
        const VisibleSurface surface = visible_surface(editor.camera, editor.viewport, editor.frame.positions,
                                                       hidden, editor.opened.spacing, editor.workers);
        keep_visible(editor.camera, editor.viewport, editor.frame.positions, surface, inside, editor.workers);
    }
    change_marks(editor, [&] { select(editor.marks, inside, command.mode, editor.workers); });
}

// A click chooses the handle that it hits; elsewhere it selects the one point, or nothing, or what is around
// it.
void carry_out(Editor& editor, const SelectPointUnder& command) {
    if (!editor.document) return;
    const Index hit = point_under(editor.camera, editor.viewport, editor.frame.positions,
                                  hidden_points(editor), command.pixel, click_radius, editor.workers);
    if (hit != no_index && command.mode == SelectMode::replace && (editor.marks[hit] & mark_handle)) {
        const Index point = editor.opened.order->file_index[hit];
        const auto& handles = editor.document->handles;
        for (std::size_t h = handles.size(); h-- > 0;)
            if (handle_mark(h) == (editor.marks[hit] & mark_handle) &&
                std::ranges::binary_search(*handles[h].points, point))
                return carry_out(editor, ChooseHandle{handles[h].name});
    }
    if (command.radius > 0)
        return carry_out(editor, SelectRegion{ScreenStroke{{command.pixel}, command.radius}, command.mode,
                                              command.through});
    std::vector<std::uint8_t> inside(editor.marks.size());
    if (hit != no_index) inside[hit] = 1;
    change_marks(editor, [&] { select(editor.marks, inside, command.mode, editor.workers); });
}

void carry_out(Editor& editor, const ChangeSelection& command) {
    if (!needs_document(editor)) return;
    const bool needs_graph = command.step == SelectionStep::grow || command.step == SelectionStep::shrink ||
                             command.step == SelectionStep::connected;
    if (needs_graph && !editor.document->graph)
        return say(editor, Notice::Kind::information,
                   "The neighbours of the points are still being found; try again in a moment.");
    const PointOrder& order = *editor.opened.order;
    change_marks(editor, [&] {
        switch (command.step) {
        case SelectionStep::all:
            return select_all(editor.marks, editor.workers);
        case SelectionStep::none:
            return select_none(editor.marks, editor.workers);
        case SelectionStep::invert:
            return invert_selection(editor.marks, editor.workers);
        case SelectionStep::grow:
            return grow_selection(editor.marks, order, *editor.document->graph, editor.workers);
        case SelectionStep::shrink:
            return shrink_selection(editor.marks, order, *editor.document->graph, editor.workers);
        case SelectionStep::connected:
            return select_connected(editor.marks, order, *editor.document->components, editor.workers);
        }
    });
}

void carry_out(Editor& editor, const ChangeHidden& command) {
    if (!needs_document(editor)) return;
    if (command.step == HideStep::hide_unselected && editor.selected == 0)
        return say(editor, Notice::Kind::information,
                   "Select what is to stay visible first: with nothing selected all would be hidden.");
    change_marks(editor, [&] {
        if (command.step == HideStep::show_all) return show_all(editor.marks, editor.workers);
        hide(editor.marks, command.step == HideStep::hide_selected, editor.workers);
    });
}

// --- The document ----------------------------------------------------------------------------------------

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
    if (!changes || editor.document->posed || editor.drag) return; // the document does, when it can
    SettingsChange change;
    change.samples = suited.samples;
    post_step(editor, {SetLine{change}});
    editor.past.back().choosing_before = false;
    editor.past.back().choosing_after = true;
}

void carry_out(Editor& editor, const CommitPose& /*command*/) {
    if (!needs_document(editor) || editor.drag) return;
    if (!editor.document->posed)
        return say(editor, Notice::Kind::information, "Nothing is posed, so there is nothing to commit.");
    post_step(editor, {CommitLine{}});
}

// --- The camera ------------------------------------------------------------------------------------------

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
    frame(editor.camera, box ? *box : bulk_box(editor.frame.positions), editor.viewport);
}

void carry_out(Editor& editor, const LookAtSide& command) {
    look_at_side(editor.camera, command.side);
}

void carry_out(Editor& editor, const SetPivotUnder& command) {
    if (!editor.document) return;
    const Index hit = point_under(editor.camera, editor.viewport, editor.frame.positions,
                                  hidden_points(editor), command.pixel, click_radius, editor.workers);
    if (hit == no_index) return;
    const float* p = editor.frame.positions.data() + 3 * std::size_t{hit};
    set_pivot(editor.camera, {p[0], p[1], p[2]});
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
                     DeleteHandle, ResetPose, MirrorHandle, BeginDrag, SetPivot, ChangeSettings,
                     ChooseSamples, CommitPose>(command);
}

// Whether it takes the pose as it is for good, or may.
bool takes_pose(const Command& command) {
    return is_one_of<MakeHandle, AssignPoints, ChangeRole, ChangeHold, DeleteHandle, MirrorHandle,
                     ChangeSettings, CommitPose>(command);
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
                "were. To go on from an earlier one, undo to it (Ctrl+Z).");
        return false;
    }
    return true;
}

bool may_take_pose(Editor& editor) {
    if (editor.status.playing)
        decline(editor,
                "This is the middle of a step, and what you do here would go on from its end. Play on to "
                "there first (Space, or Right frame by frame).");
    return !editor.status.playing;
}

void apply(Editor& editor, const Command& command) {
    try {
        if (is_act(command) && !may_act(editor)) return;
        if (takes_pose(command) && !may_take_pose(editor)) return;
        std::visit([&](const auto& c) { carry_out(editor, c); }, command);
    } catch (const Error& error) {
        say(editor, Notice::Kind::error, words_in_window(error));
    } catch (const std::bad_alloc&) {
        say(editor, Notice::Kind::error, "There is not enough memory for this.");
    }
}

void save_cloud(Editor& editor, std::filesystem::path target, SaveColumns columns, bool anyway) {
    editor.live->save_cloud(std::move(target), columns, anyway);
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
    if (context.gizmo && editor.drag) context.local_axes = editor.drag->local_axes;
    if (context.gizmo && !editor.drag)
        for (std::size_t h = 0; h < editor.document->handles.size(); ++h)
            if (editor.document->handles[h].name == editor.chosen)
                context.local_axes = to_glm(editor.document->motions[h].rotation);
    std::vector<Command> commands;
    const bool used = handle_input(editor.tools, context, input, commands);
    for (const Command& command : commands) apply(editor, command);
    return used;
}

} // namespace knead

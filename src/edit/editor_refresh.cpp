// How an editor opens a file, and takes in what the live document has made since it looked last.

#include "edit/editor_steps.h"
#include "view/framing.h"

#include <algorithm>
#include <utility>

namespace knead {

void open(Editor& editor, OpenRequest request) {
    editor.opening_request = request;
    editor.opening = std::make_unique<LiveDocument>(std::move(request));
}

void cancel_opening(Editor& editor) {
    if (editor.opening) editor.opening->cancel_opening();
}

namespace {

// Of the steps of a session that was opened, as if they had been done here.
void take_told_pivots(Editor& editor) {
    const auto glm_of = [](const std::optional<Vec3d>& place) {
        return place ? std::optional(to_glm(*place)) : std::nullopt;
    };
    const auto& moves = editor.opened.pivot_moves;
    for (std::size_t step = 0; step < moves.size(); ++step) {
        const bool is_past = step < editor.past.size(); // the next one to be redone is the last of the future
        EditorStep& taken = is_past ? editor.past[step] : editor.future[moves.size() - 1 - step];
        for (const Document::PivotMove& move : moves[step]) {
            taken.pivots.push_back({move.handle, glm_of(move.before), glm_of(move.after)});
            if (is_past) put_pivot(editor, move.handle, glm_of(move.after));
        }
    }
}

// Where no line tells of a pivot: handles are dragged about their middles unless the hand put their pivots
// elsewhere. Where these were before the last step nobody knows, so they go with it when it is undone.
void take_last_pivots(Editor& editor) {
    if (editor.past.empty()) return; // nothing was dragged
    const double least = 1e-4 * editor.opened.bounds.diagonal();
    for (const Handle& handle : editor.document->handles) {
        const auto last = editor.opened.last_pivots.find(handle.name);
        if (last == editor.opened.last_pivots.end()) continue;
        const glm::dvec3 place = to_glm(last->second);
        const std::optional<glm::dvec3> middle = middle_of(editor, handle);
        if (middle && glm::distance(place, *middle) > least)
            put_pivot_with(editor.past.back(), editor, handle.name, place);
    }
}

// The last words of what was there: what became of its saves, above all.
void take_last_words(Editor& editor) {
    std::ranges::move(editor.live->take_notices(), std::back_inserter(editor.notices));
    for (const HeldSave& held : editor.live->take_held_saves())
        say(editor, Notice::Kind::error,
            held.target.string() + " was not written: it was changed by another program meanwhile.");
}

// What was opened takes the place of what was there, of which nothing is to be restored: whoever opens a file
// was asked about it.
void take_over(Editor& editor) {
    if (editor.live) {
        take_last_words(editor);
        editor.live->discard_journal();
    }
    editor.live = std::move(editor.opening);
    editor.opened = editor.live->opened();
    editor.document = editor.live->view();
    editor.chooses_samples = editor.document->chooses_samples;
    editor.frame = {};
    editor.live->take_frame(editor.frame);
    static_cast<EditorOfDocument&>(editor) = {};
    std::vector<Command> of_before;
    drop_everything(editor.tools, of_before);

    editor.ordered.assign(editor.opened.cloud->size(), no_index);
    const std::vector<Index>& file_index = editor.opened.order->file_index;
    for (Index i = 0; i < file_index.size(); ++i) editor.ordered[file_index[i]] = i;
    editor.marks.assign(file_index.size(), 0);
    editor.past.assign(editor.document->undoable_steps, EditorStep{step_of_opened_session});
    editor.future.assign(editor.document->redoable_steps, EditorStep{step_of_opened_session});
    mark_handles(editor);
    take_told_pivots(editor);
    take_last_pivots(editor);
    editor.camera = first_view(bulk_box(editor.frame.positions()), editor.viewport);
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

// Those of steps that the document has answered.
template<typename IsAnswered>
void forget_names(Editor& editor, IsAnswered&& is_answered) {
    for (auto* names : {&editor.posted_names, &editor.names_to_go})
        std::erase_if(*names, [&](const auto& posted) { return is_answered(posted.first); });
}

// A step that the document refused is no step: it leaves the history, and the selection comes back.
void forget_refused(Editor& editor) {
    for (const auto [step, ends_redo] : editor.live->take_refused()) {
        forget_names(editor, [&](StepNumber of) { return of == step; });
        find_counterparts(editor); // some names stay that were to go
        forget_future(editor, step);
        for (EditorStep& past : editor.past)
            if (past.joined == step) past.joined = 0;
        forget_drag(editor, step);
        const auto found = std::ranges::find(editor.past, step, &EditorStep::document);
        if (found == editor.past.end()) continue;
        editor.just_made.clear();
        if (found->before) restore_selection(editor, *found->before);
        if (found->chosen_before && found->chosen_after == editor.chosen)
            choose(editor, *found->chosen_before);
        if (found->choosing_before) choose_samples(editor, *found->choosing_before);
        take_pivots_back(editor, *found);
        const auto at = static_cast<std::size_t>(found - editor.past.begin());
        const bool is_last = at + 1 == editor.past.size() && editor.future.empty();
        if (is_last && !ends_redo) editor.future = std::move(found->undone);
        editor.past.erase(found);
        if (editor.looks_from && at < *editor.looks_from) --*editor.looks_from;
    }
}

// Those that are there, or will be by that name, and move.
void keep_also_chosen(Editor& editor) {
    const Handle* chosen = chosen_handle(editor);
    if (chosen && chosen->role != HandleRole::moving) editor.also_chosen.clear();
    std::erase_if(editor.also_chosen, [&](const std::string& name) {
        if (const Handle* handle = handle_named(editor.document->handles, name))
            return handle->role != HandleRole::moving;
        return std::ranges::none_of(editor.posted_names,
                                    [&](const auto& posted) { return posted.second == name; });
    });
}

bool refresh_view(Editor& editor) {
    auto view = editor.live->view();
    if (view == editor.document) return false;
    const bool other_handles = !hold_the_same(view->handles, editor.document->handles);
    const bool other_names =
        !std::ranges::equal(view->handles, editor.document->handles, {}, &Handle::name, &Handle::name);
    editor.document = std::move(view);
    editor.opened.file = editor.document->cloud;
    if (other_handles) mark_handles(editor);
    const std::size_t also_chosen = editor.also_chosen.size();
    keep_also_chosen(editor);
    const StepNumber done = editor.document->last_step;
    const std::size_t to_go = editor.names_to_go.size();
    forget_names(editor, [&](StepNumber of) { return of <= done; });
    if (other_handles || other_names || to_go != editor.names_to_go.size() ||
        also_chosen != editor.also_chosen.size())
        find_counterparts(editor);
    for (EditorStep& step : editor.past)
        if (step.document <= done) step.undone.clear();
    if (editor.drag && editor.drag->ended && done >= editor.drag->step) editor.drag.reset();
    std::erase_if(editor.earlier_drags, [&](const EditorDrag& drag) { return drag.step <= done; });
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
    if (editor.live->take_frame(editor.frame)) {
        editor.changes.positions = true;
        changed = true;
    }
    if (changed && !editor.drag && !editor.frame.on_device) // of points that are known
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

} // namespace knead

// The editor's steps: how they get on the history, and how they are taken back, done again and played.

#include "base/quoted.h"
#include "base/require.h"
#include "edit/editor_steps.h"
#include "edit/selecting.h"

#include <algorithm>
#include <utility>

namespace knead {

std::shared_ptr<const KeptMarks> snapshot(const Editor& editor) {
    KeptMarks marks(editor.marks);
    const auto last = std::ranges::find_if(
        editor.past.rbegin(), editor.past.rend(), [](const auto& after) { return after != nullptr; },
        &EditorStep::after);
    if (last != editor.past.rend() && *last->after == marks) return last->after;
    return std::make_shared<const KeptMarks>(std::move(marks));
}

EditorStep coming_step(Editor& editor, StepNumber document, std::shared_ptr<const KeptMarks> before) {
    const auto after = before ? snapshot(editor) : nullptr;
    EditorStep step{document, std::move(before), after};
    if (document) step.chosen_before = step.chosen_after = editor.chosen;
    std::vector<EditorStep>& past = editor.past;
    if (past.size() == past.capacity()) past.reserve(2 * past.size() + 1);
    return step;
}

void add_step(Editor& editor, EditorStep step) noexcept {
    if (step.document) step.undone = std::move(editor.future);
    editor.future.clear();
    editor.looks_from.reset(); // whoever acts goes on from here
    editor.just_made.clear();
    editor.just_clicked.reset();
    editor.past.push_back(std::move(step));
}

void change_marks(Editor& editor, const std::function<void()>& change) {
    auto before = snapshot(editor);
    change();
    if (*before == *snapshot(editor)) return;
    marks_changed(editor);
    add_step(editor, coming_step(editor, 0, std::move(before)));
}

StepNumber post_step(Editor& editor, std::vector<SessionAction> lines,
                     std::shared_ptr<const KeptMarks> marks_before) {
    EditorStep step = coming_step(editor, ++editor.last_step, std::move(marks_before));
    editor.live->post(step.document, std::move(lines));
    add_step(editor, std::move(step));
    return editor.last_step;
}

void choose(Editor& editor, const std::string& handle) {
    if (handle != editor.chosen) editor.also_chosen.clear();
    editor.chosen = handle;
    editor.just_made.clear();
    if (const Handle* there = chosen_handle(editor))
        editor.handle_middle = middle_of(editor, *there).value_or(glm::dvec3(0.0));
    find_counterparts(editor);
}

void choose_with_step(Editor& editor, const std::string& handle) {
    choose(editor, handle);
    if (!editor.past.empty()) editor.past.back().chosen_after = handle;
}

void choose_samples(Editor& editor, bool by_itself) {
    editor.chooses_samples = by_itself;
    editor.live->choose_samples(by_itself);
}

void restore_selection(Editor& editor, const KeptMarks& from) {
    from.restore(editor.marks);
    marks_changed(editor);
}

void forget_last_selection(Editor& editor) {
    require(!editor.past.empty() && editor.past.back().before, "the newest step is one of selection");
    restore_selection(editor, *editor.past.back().before);
    editor.past.pop_back();
}

void marks_changed(Editor& editor) {
    const MarkCounts counts = count_marks(editor.marks);
    editor.selected = counts.selected;
    editor.hidden = counts.hidden;
    editor.changes.marks = true;
    ++editor.marks_version;
}

namespace {

std::string words_of(const EditorStep& step, const std::string& of_document) {
    if (step.document != 0) return of_document;
    if (!step.pivots.empty()) return "the pivot of " + quoted(step.pivots.front().handle) + " moved";
    return step.before ? "a selection, or what is hidden" : std::string();
}

} // namespace

std::string words_of_undo(const Editor& editor) {
    if (!can_undo(editor) || editor.status.busy) return {};
    return words_of(editor.past.back(), editor.document->last_words);
}

std::string words_of_redo(const Editor& editor) {
    if (!can_redo(editor) || editor.status.busy) return {};
    return words_of(editor.future.back(), editor.document->next_words);
}

namespace {

std::string sentence(const char* what, const std::string& words) {
    return words.empty() ? std::string() : what + words;
}

void begin_looking(Editor& editor) {
    if (!editor.looks_from) editor.looks_from = editor.past.size();
}

} // namespace

void carry_out(Editor& editor, const UndoStep& command) {
    // Whoever looks back undoes to what they look at.
    if (!command.to_look && looks_back(editor)) carry_out(editor, RedoStep{.to_look = true});
    if (!can_undo(editor)) return;
    editor.just_made.clear();
    if (!command.to_look) editor.just_done = sentence("Taken back: ", words_of_undo(editor));
    if (command.to_look)
        begin_looking(editor);
    else
        editor.looks_from.reset();
    EditorStep step = std::move(editor.past.back());
    editor.past.pop_back();
    step.undone.clear();
    if (step.before) restore_selection(editor, *step.before);
    if (step.document) editor.live->undo(step.document, command.to_look);
    if (step.choosing_before) choose_samples(editor, *step.choosing_before);
    if (step.chosen_before) choose(editor, *step.chosen_before);
    take_pivots_back(editor, step);
    forget_drag(editor, step.document);
    editor.future.push_back(std::move(step));
}

namespace {

template<typename Redo>
void go_forward(Editor& editor, Redo&& redo) {
    if (!can_redo(editor)) return;
    EditorStep step = std::move(editor.future.back());
    editor.future.pop_back();
    if (step.document) redo(step.document);
    if (step.choosing_after) choose_samples(editor, *step.choosing_after);
    if (step.after) restore_selection(editor, *step.after);
    if (step.chosen_after) choose(editor, *step.chosen_after);
    for (const PivotMove& move : step.pivots) put_pivot(editor, move.handle, move.after);
    editor.past.push_back(std::move(step));
}

} // namespace

// Whoever looks back goes on looking, until they are where that began.
void carry_out(Editor& editor, const RedoStep& command) {
    if (command.to_look && can_redo(editor)) begin_looking(editor);
    const bool to_look = command.to_look || looks_back(editor);
    if (!to_look && can_redo(editor)) editor.just_done = sentence("Done again: ", words_of_redo(editor));
    go_forward(editor, [&](StepNumber step) { editor.live->redo(step, to_look); });
    if (!command.to_look && !looks_back(editor)) editor.looks_from.reset();
}

void carry_out(Editor& editor, const PlayStep& /*command*/) {
    if (can_redo(editor)) begin_looking(editor);
    go_forward(editor, [&](StepNumber step) { editor.live->play(step); });
}

void carry_out(Editor& editor, const PacePlaying& command) {
    if (editor.document) editor.live->set_play_pace(command.speed, command.held);
}

void carry_out(Editor& editor, const AdvancePlaying& command) {
    if (editor.document) editor.live->advance_play(command.frames);
}

} // namespace knead

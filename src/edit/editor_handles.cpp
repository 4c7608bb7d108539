// What the editor does to handles: making, choosing and changing them. How they are posed is
// editor_poses.cpp.

#include "base/counts.h"
#include "base/quoted.h"
#include "edit/editor_steps.h"
#include "edit/handle_lines.h"

#include <algorithm>
#include <utility>

namespace knead {

namespace {

std::string_view word_for(HandleRole role) {
    switch (role) {
    case HandleRole::fixed:
        return "fixed";
    case HandleRole::region_of_interest:
        return "region";
    case HandleRole::moving:
        break;
    }
    return "handle";
}

void post_edit(Editor& editor, HandleEdit edit, std::shared_ptr<const KeptMarks> marks_before) {
    EditorStep step = coming_step(editor, ++editor.last_step, std::move(marks_before));
    editor.live->edit_handle(step.document, std::move(edit));
    add_step(editor, std::move(step));
}

// The document knows best what there is to change: earlier acts may be on their way to it, of which nothing
// is seen here yet.
void edit_handle(Editor& editor, HandleEdit edit) {
    const bool is_known = number_of(editor, edit.handle).has_value();
    if (!is_known || (!has_pending_steps(editor) && !changes(editor.document->handles, edit))) return;
    post_edit(editor, std::move(edit), nullptr);
}

// What is selected, which a handle's tint takes the place of: nothing is selected any more.
auto take_selection(Editor& editor) {
    auto before = snapshot(editor);
    select_none(editor.marks, editor.workers);
    marks_changed(editor);
    return before;
}

// How many points follow a handle, and how many of them are selected.
struct Held {
    std::size_t points = 0, selected = 0;
};
std::vector<Held> held_by_each(const Editor& editor) {
    const std::vector<Index> follows = followed_handles(editor);
    std::vector<Held> held(editor.document->handles.size());
    for (std::size_t point = 0; point < follows.size(); ++point) {
        if (follows[point] == no_index) continue;
        ++held[follows[point]].points;
        held[follows[point]].selected += (editor.marks[point] & mark_selected) != 0;
    }
    return held;
}

// A handle that is given these marks takes the points that it shares with others; a region takes none of
// theirs. Says from whom it takes.
void tell_who_is_robbed(Editor& editor, HandleRole role, const std::string& name) {
    if (role == HandleRole::region_of_interest) return;
    std::string words;
    const std::vector<Held> each = held_by_each(editor);
    for (std::size_t h = 0; h < editor.document->handles.size(); ++h) {
        const Handle& handle = editor.document->handles[h];
        if (handle.role == HandleRole::region_of_interest || handle.name == name) continue;
        const Held& held = each[h];
        if (held.selected == 0) continue;
        words += (words.empty() ? " takes " : ", and ") + counted(held.selected, "point") + " from " +
                 quoted(handle.name);
        if (held.selected == held.points) words += ", which holds none any more";
    }
    if (!words.empty())
        say(editor, Notice::Kind::information,
            quoted(name) + words + ": what several hold follows the one that took it last.");
}

} // namespace

std::optional<std::size_t> number_of(const Editor& editor, const std::string& name) {
    return editor.document ? number_of(editor.document->handles, name) : std::nullopt;
}

bool is_free(const Editor& editor, const std::string& name) {
    return !number_of(editor, name) && std::ranges::none_of(editor.posted_names, [&](const auto& posted) {
        return posted.second == name;
    });
}

bool will_be_there(const Editor& editor, const std::string& name) {
    const auto last_of = [&](const auto& names) {
        StepNumber last = 0;
        for (const auto& [step, posted] : names)
            if (posted == name) last = std::max(last, step);
        return last;
    };
    const StepNumber comes = last_of(editor.posted_names), goes = last_of(editor.names_to_go);
    return comes == goes ? number_of(editor, name).has_value() : comes > goes; // equal: neither
}

std::string free_name(const Editor& editor, HandleRole role) {
    for (unsigned number = 1;; ++number) {
        std::string name = std::string(word_for(role)) + " " + std::to_string(number);
        if (is_free(editor, name)) return name;
    }
}

// The selection becomes the handle, and the handle's tint takes its place on the screen.
void carry_out(Editor& editor, const MakeHandle& command) {
    if (!needs_document(editor)) return;
    if (editor.selected == 0)
        return say(editor, Notice::Kind::information,
                   "Select the points of the handle first: " + way_to_select(editor.tools.select) + " them.");
    HandleLine line;
    line.name = command.name.empty() ? free_name(editor, command.role) : command.name;
    line.role = command.role;
    line.points = selected_ranges(editor.marks, *editor.opened.order, editor.opened.cloud->size());
    tell_who_is_robbed(editor, command.role, line.name);
    auto before = take_selection(editor);
    const std::string name = line.name;
    const StepNumber step = post_step(editor, {std::move(line)}, std::move(before));
    editor.posted_names.emplace_back(step, name);
    if (command.role == HandleRole::moving) choose_with_step(editor, name);
    editor.just_made = name;
}

void carry_out(Editor& editor, const ChooseHandle& command) {
    editor.also_chosen.clear();
    choose(editor, command.handle);
}

void carry_out(Editor& editor, const ChooseAlso& command) {
    const auto is_moving = [&](const std::string& name) {
        const auto number = number_of(editor, name);
        return number && editor.document->handles[*number].role == HandleRole::moving;
    };
    if (!is_moving(editor.chosen)) return carry_out(editor, ChooseHandle{command.handle});
    if (command.handle == editor.chosen) return;
    if (!is_moving(command.handle))
        return say(editor, Notice::Kind::information,
                   quoted(command.handle) + " is no moving handle, so it cannot go along.");
    if (goes_mirrored(editor, command.handle))
        return say(editor, Notice::Kind::information,
                   quoted(command.handle) + " goes along as it is, mirrored.");
    if (std::erase(editor.also_chosen, command.handle) == 0) editor.also_chosen.push_back(command.handle);
    find_counterparts(editor);
}

std::vector<std::string> chosen_with(const Editor& editor, const std::string& handle) {
    const bool is_one_of_them =
        handle == editor.chosen || std::ranges::find(editor.also_chosen, handle) != editor.also_chosen.end();
    std::vector<std::string> handles{handle};
    if (!is_one_of_them) return handles;
    const auto add = [&](const std::string& other) {
        if (other != handle && will_be_there(editor, other)) handles.push_back(other);
    };
    add(editor.chosen);
    std::ranges::for_each(editor.also_chosen, add);
    return handles;
}

void carry_out(Editor& editor, const DropChoice& /*command*/) {
    if (editor.selected > 0)
        apply(editor, ChangeSelection{SelectionStep::none});
    else
        apply(editor, ChooseHandle{});
}

void carry_out(Editor& editor, const RenameHandle& command) {
    const bool is_blank = std::ranges::all_of(command.to, [](char letter) { return letter == ' '; });
    if (!number_of(editor, command.handle) || is_blank || command.to == command.handle) return;
    if (number_of(editor, command.to))
        return say(editor, Notice::Kind::error, "There is a handle " + quoted(command.to) + " already.");
    const StepNumber step = post_step(editor, {RenameLine{command.handle, command.to}});
    editor.posted_names.emplace_back(step, command.to);
    editor.names_to_go.emplace_back(step, command.handle);
    put_pivot_with(editor.past.back(), editor, command.to, pivot_of(editor, command.handle));
    put_pivot_with(editor.past.back(), editor, command.handle, std::nullopt);
    std::vector<std::string> also = editor.also_chosen;
    std::ranges::replace(also, command.handle, command.to);
    if (editor.chosen == command.handle) choose_with_step(editor, command.to);
    editor.also_chosen = std::move(also);
    find_counterparts(editor);
}

// As with a new handle, the tint of what the handle has now takes the place of the selection.
void carry_out(Editor& editor, const AssignPoints& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    if (editor.selected == 0)
        return say(editor, Notice::Kind::information,
                   "Select the points first: " + way_to_select(editor.tools.select) + " them.");
    const Handle& handle = editor.document->handles[*number];
    HandleEdit edit{.handle = command.handle};
    edit.points = {command.mode,
                   selected_ranges(editor.marks, *editor.opened.order, editor.opened.cloud->size())};
    if (!has_pending_steps(editor) && !changes(editor.document->handles, edit)) {
        const bool takes_away = command.mode == SelectMode::remove;
        return say(editor, Notice::Kind::information,
                   quoted(handle.name) + " " +
                       (!takes_away ? "holds just these points already."
                        : held_by_each(editor)[*number].selected > 0
                            ? "would hold no point any more: delete it."
                            : "holds none of the selected points."));
    }
    if (command.mode != SelectMode::remove) tell_who_is_robbed(editor, handle.role, handle.name);
    post_edit(editor, std::move(edit), take_selection(editor));
}

void carry_out(Editor& editor, const ChangeRole& command) {
    edit_handle(editor, {.handle = command.handle, .role = command.role});
}

void carry_out(Editor& editor, const ChangeHold& command) {
    edit_handle(editor, {.handle = command.handle, .hold = {{command.free_rotation, command.falloff}}});
}

// The handle stays the same one, so whatever was declared later and what is posed stay as they are.
void carry_out(Editor& editor, const ColorHandle& command) {
    edit_handle(editor, {.handle = command.handle, .color = {{command.color}}});
}

void carry_out(Editor& editor, const DeleteHandles& command) {
    std::vector<std::string> handles = command.handles;
    std::erase_if(handles, [&](const std::string& name) { return !will_be_there(editor, name); });
    if (handles.empty()) return;
    std::vector<SessionAction> lines;
    for (const std::string& name : handles) lines.emplace_back(DeleteLine{name});
    post_step(editor, std::move(lines));
    for (const std::string& name : handles) {
        put_pivot_with(editor.past.back(), editor, name, std::nullopt);
        editor.names_to_go.emplace_back(editor.last_step, name);
    }
    find_counterparts(editor);
    const std::string words =
        handles.size() == 1 ? quoted(std::as_const(handles).front()) + " is deleted, and its points stay"
                            : counted(handles.size(), "handle") + " are deleted, and their points stay";
    editor.just_done = words + "; Ctrl+Z takes it back";
}

void carry_out(Editor& editor, const SelectHandlePoints& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    std::vector<std::uint8_t> inside(editor.marks.size(), 0);
    for (const Index i : *editor.document->handles[*number].points)
        if (editor.ordered[i] != no_index) inside[editor.ordered[i]] = 1;
    change_marks(editor, [&] { select(editor.marks, inside, command.mode, editor.workers); });
}

} // namespace knead

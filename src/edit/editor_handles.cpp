// What the editor does to handles: making, changing, mirroring and dragging them.

#include "base/counts.h"
#include "base/quoted.h"
#include "edit/editor_steps.h"
#include "edit/handle_lines.h"
#include "edit/handle_motion.h"
#include "edit/mirroring.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>

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

std::optional<std::size_t> number_of(const Editor& editor, const std::string& name) {
    if (!editor.document) return std::nullopt;
    const auto& handles = editor.document->handles;
    const auto found = std::ranges::find(handles, name, &Handle::name);
    if (found == handles.end()) return std::nullopt;
    return static_cast<std::size_t>(found - handles.begin());
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

bool is_free(const Editor& editor, const std::string& name) {
    return !number_of(editor, name) && std::ranges::none_of(editor.posted_names, [&](const auto& posted) {
        return posted.second == name;
    });
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
}

void carry_out(Editor& editor, const ChooseHandle& command) {
    choose(editor, command.handle);
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
    put_pivot_with(editor.past.back(), editor, command.to, pivot_of(editor, command.handle));
    put_pivot_with(editor.past.back(), editor, command.handle, std::nullopt);
    if (editor.chosen == command.handle) choose_with_step(editor, command.to);
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

void carry_out(Editor& editor, const DeleteHandle& command) {
    if (!number_of(editor, command.handle)) return;
    post_step(editor, {DeleteLine{command.handle}});
    put_pivot_with(editor.past.back(), editor, command.handle, std::nullopt);
}

void carry_out(Editor& editor, const SelectHandlePoints& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    std::vector<std::uint8_t> inside(editor.marks.size(), 0);
    for (const Index i : *editor.document->handles[*number].points)
        if (editor.ordered[i] != no_index) inside[editor.ordered[i]] = 1;
    change_marks(editor, [&] { select(editor.marks, inside, command.mode, editor.workers); });
}

// --- Poses that are not dragged ----------------------------------------------------------------------------

namespace {

std::string words_about(const MirrorPlane& plane, double place) {
    char text[64];
    std::snprintf(text, sizeof text, "%c = %.4g", "xyz"[plane.axis], place);
    return text + std::string(plane.is_middle ? ", the middle of the cloud"
                                              : ", where the cloud is most like its mirror image");
}

// Whether a good part of these are the same points; both ascend. The shape that a handle was mirrored in may have been
// bent since, and the plane lie elsewhere.
bool are_alike(const std::vector<Index>& a, const std::vector<Index>& b) {
    std::vector<Index> both;
    std::ranges::set_intersection(a, b, std::back_inserter(both));
    return 4 * both.size() > std::max(a.size(), b.size());
}

// The line of a mirrored handle. Mirrored once more to where it was mirrored before, it is the one that was
// made then.
HandleLine line_of_mirrored(const Editor& editor, const Handle& handle, const std::vector<Index>& points) {
    HandleLine line = line_of(handle);
    line.color.reset(); // it has its own
    line.points = ranges_of(points);
    for (unsigned number = 1;; ++number) {
        line.name = handle.name + " mirrored" + (number > 1 ? " " + std::to_string(number) : "");
        if (is_free(editor, line.name)) return line;
        const auto there = number_of(editor, line.name);
        if (!there || !are_alike(*editor.document->handles[*there].points, points)) continue;
        const Handle& twin = editor.document->handles[*there];
        line.color = twin.color;
        line.points = ranges_of(*twin.points);
        return line;
    }
}

// Where the points are in this edit while no handle is moved.
std::span<const float> rest_positions(const Editor& editor) {
    if (editor.document->rest) return editor.document->rest->positions;
    if (editor.document->posed) return editor.opened.opened->positions;
    return editor.frame.positions();
}

} // namespace

void carry_out(Editor& editor, const ResetPose& command) {
    const auto number = number_of(editor, command.handle);
    if (!number || editor.document->handles[*number].role != HandleRole::moving) return;
    if (!is_or_will_be_posed(editor)) return;
    EditorStep step = coming_step(editor, ++editor.last_step);
    editor.live->reset_pose(step.document, command.handle);
    add_step(editor, std::move(step));
    if (const auto pivot = pivot_of(editor, command.handle)) {
        const Vec3d at_rest = point_at_rest(motion_now(editor, *number), to_eigen(*pivot));
        put_pivot_with(editor.past.back(), editor, command.handle, to_glm(at_rest));
    }
}

void carry_out(Editor& editor, const MirrorHandle& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    const Handle& handle = editor.document->handles[*number];
    const std::span<const float> positions = rest_positions(editor);
    const MirrorPlane plane = mirror_plane(positions, command.axis, editor.opened.spacing);
    const PartAcross across = part_across(editor, positions, handle, plane, 3 * editor.opened.spacing);
    const std::vector<Index>& points = across.points;
    const double place = plane.at + editor.opened.cloud->origin[command.axis];
    if (points.empty())
        return say(editor, Notice::Kind::error,
                   "There is nothing across " + words_about(plane, place) + ", where " + quoted(handle.name) +
                       " would be mirrored to.");
    if (!plane.is_middle)
        say(editor, Notice::Kind::information, "Mirrored across " + words_about(plane, place) + ".");
    const HandleMotion motion = motion_now(editor, *number);
    HandleLine line = line_of_mirrored(editor, handle, points);
    const auto pivot = pivot_of(editor, command.handle);
    const auto over_there = [&](const Vec3d& p) { return mirrored(p, plane, across.shift); };
    line.pivot = std::nullopt;
    if (pivot) line.pivot = over_there(point_at_rest(motion, to_eigen(*pivot))) + editor.opened.cloud->origin;
    const std::string name = line.name;
    if (handle.role == HandleRole::moving && leaves_rest(motion)) {
        PoseOfAnother pose{handle.name,
                           [=](const HandleMotion& seen) { return mirrored(seen, plane, across.shift); }};
        EditorStep step = coming_step(editor, ++editor.last_step);
        editor.live->make_posed(step.document, std::move(line), std::move(pose));
        add_step(editor, std::move(step));
    } else {
        post_step(editor, {std::move(line)});
        if (handle.role == HandleRole::moving)
            say(editor, Notice::Kind::information,
                "Only the handle was mirrored: " + quoted(handle.name) +
                    " is where it was at rest, so there is no pose to mirror.");
    }
    put_pivot_with(editor.past.back(), editor, name,
                   pivot ? std::optional(to_glm(over_there(to_eigen(*pivot)))) : std::nullopt);
    editor.posted_names.emplace_back(editor.last_step, name);
    choose_with_step(editor, name);
}

// --- Dragging ---

void forget_drag(Editor& editor, StepNumber step) {
    if (editor.drag && editor.drag->step == step) editor.drag.reset();
    std::erase_if(editor.earlier_drags, [&](const EditorDrag& drag) { return drag.step == step; });
}

void carry_out(Editor& editor, const BeginDrag& command) {
    const auto number = number_of(editor, editor.chosen);
    if (!number || editor.document->handles[*number].role != HandleRole::moving) return;
    if (editor.drag && !editor.drag->ended) return; // one at a time
    const ChosenPose pose = *pose_of_chosen(editor);
    EditorDrag drag;
    drag.step = ++editor.last_step;
    drag.handle = editor.chosen;
    drag.middle = pose.pivot;
    drag.motion = {pose.motion, pose.motion};
    EditorStep step = coming_step(editor, drag.step);
    step.is_drag = true;
    editor.live->begin_drag(drag.step, editor.chosen, to_eigen(command.pivot) + editor.opened.cloud->origin);
    if (editor.drag) editor.earlier_drags.push_back(std::move(*editor.drag));
    editor.drag = std::move(drag);
    add_step(editor, std::move(step));
}

void carry_out(Editor& editor, const DragTo& command) {
    if (!editor.drag || editor.drag->ended) return;
    Transform transform = command.transform;
    transform.angle = within_turns(transform.angle);
    carry_on(editor.drag->motion, transform);
    editor.drag->transform = transform;
    editor.live->drag_to(transform);
}

void carry_out(Editor& editor, const EndDrag& /*command*/) {
    if (!editor.drag || editor.drag->ended) return;
    editor.drag->ended = true;
    const glm::dvec3 middle = transformed(editor.drag->transform, editor.drag->middle);
    if (editor.chosen == editor.drag->handle) editor.handle_middle = middle;
    // What the gizmo stands on went along, be it the pivot or the middle.
    const auto step = std::ranges::find(editor.past, editor.drag->step, &EditorStep::document);
    if (step != editor.past.end() && pivot_of(editor, editor.drag->handle))
        put_pivot_with(*step, editor, editor.drag->handle, middle);
    editor.live->end_drag();
}

void carry_out(Editor& editor, const CancelDrag& /*command*/) {
    if (!editor.drag || editor.drag->ended) return;
    const auto step = std::ranges::find(editor.past, editor.drag->step, &EditorStep::document);
    if (step != editor.past.end()) {
        if (step + 1 == editor.past.end()) editor.future = std::move(step->undone);
        editor.past.erase(step);
    }
    editor.drag.reset();
    editor.live->cancel_drag();
}

namespace {

std::string words_about_nothing_chosen(const Editor& editor) {
    if (looks_back(editor))
        return "An earlier step is shown: Esc leads back to where you were, and Space plays on from here.";
    if (!editor.document) return {};
    const auto is_moving = [](const Handle& handle) { return handle.role == HandleRole::moving; };
    if (std::ranges::any_of(editor.document->handles, is_moving))
        return "No handle is chosen: click a moving one, in the view or in the list.";
    return next_step(editor);
}

} // namespace

void carry_out(Editor& editor, const RefuseTransform& command) {
    const Handle* chosen = chosen_handle(editor);
    if (!chosen) return say(editor, Notice::Kind::information, words_about_nothing_chosen(editor));
    if (chosen->role != HandleRole::moving)
        return say(editor, Notice::Kind::information,
                   quoted(chosen->name) +
                       " is no moving handle: choose one that is, or right-click this one in "
                       "the list to make it one.");
    if (!gizmo_of(editor)) return;
    const bool scales = command.kind == TransformKind::scale;
    say(editor, Notice::Kind::information,
        (scales ? "Scaling \"" : "Turning \"") + editor.chosen +
            "\" about itself changes nothing: it is one point that leaves rotation free. Move it with G; or "
            "right-click it in the list and tick \"Holds rotation\", to " +
            (scales ? "scale" : "turn") + " what is around it.");
}

} // namespace knead

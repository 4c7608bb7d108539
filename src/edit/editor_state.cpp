// What follows from the editor's state.

#include "base/counts.h"
#include "base/quoted.h"
#include "edit/editor_steps.h"
#include "edit/measures.h"

#include <algorithm>
#include <limits>

namespace knead {

namespace {

// Of a handle's points, so many are enough to know their middle.
constexpr std::size_t enough_for_middle = 5000;

Box3 nowhere() {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    return {glm::dvec3(infinity), glm::dvec3(-infinity)};
}

void extend(Box3& box, const float* p) {
    const glm::dvec3 point(p[0], p[1], p[2]);
    box.lowest = glm::min(box.lowest, point);
    box.highest = glm::max(box.highest, point);
}

const Handle* handle_named(const Editor& editor, const std::string& name) {
    return editor.document ? handle_named(editor.document->handles, name) : nullptr;
}

} // namespace

const Handle* chosen_handle(const Editor& editor) {
    return handle_named(editor, editor.chosen);
}

const Handle* handle_to_name(const Editor& editor) {
    return editor.just_made.empty() ? chosen_handle(editor) : handle_named(editor, editor.just_made);
}

std::vector<Index> followed_handles(const Editor& editor) {
    const std::vector<Handle>& handles = editor.document->handles;
    std::vector<Index> follows(editor.marks.size(), no_index);
    for (const bool region_pass : {true, false})
        for (std::size_t h = 0; h < handles.size(); ++h) {
            if ((handles[h].role == HandleRole::region_of_interest) != region_pass) continue;
            for (const Index i : *handles[h].points)
                if (editor.ordered[i] != no_index) follows[editor.ordered[i]] = static_cast<Index>(h);
        }
    return follows;
}

void mark_handles(Editor& editor) {
    const std::vector<Index> follows = followed_handles(editor);
    editor.followers.assign(editor.document->handles.size(), 0);
    for (std::size_t point = 0; point < follows.size(); ++point) {
        std::uint8_t& mark = editor.marks[point];
        mark = static_cast<std::uint8_t>(mark & marks_of_selection);
        if (follows[point] == no_index) continue;
        mark = static_cast<std::uint8_t>(mark | handle_mark(follows[point]));
        ++editor.followers[follows[point]];
    }
    marks_changed(editor);
}

std::size_t followers_of(const Editor& editor, const Handle& handle) {
    const auto number = number_of(editor, handle.name);
    return number && *number < editor.followers.size() ? editor.followers[*number] : handle.points->size();
}

std::optional<Vec3d> middle_in(std::span<const float> positions, const Editor& editor, const Handle& handle) {
    const std::vector<Index>& points = *handle.points;
    const std::size_t stride = std::max<std::size_t>(1, points.size() / enough_for_middle);
    Vec3d sum = Vec3d::Zero();
    double count = 0;
    for (std::size_t k = 0; k < points.size(); k += stride) {
        const Index i = editor.ordered[points[k]];
        if (i == no_index) continue;
        sum += point_at(positions, i);
        ++count;
    }
    if (count == 0) return std::nullopt;
    return sum / count;
}

std::optional<glm::dvec3> middle_of(const Editor& editor, const Handle& handle) {
    const auto middle = middle_in(editor.frame.positions(), editor, handle);
    return middle ? std::optional(to_glm(*middle)) : std::nullopt;
}

std::span<const float> rest_positions(const Editor& editor) {
    if (editor.document->rest) return editor.document->rest->positions;
    if (editor.document->posed) return editor.opened.opened->positions;
    return editor.frame.positions();
}

namespace {

// Whether the handle is a place about which the surface turns as it likes, so that turning or scaling the
// handle about itself changes nothing.
bool is_free_place(const Editor& editor, const Handle& handle) {
    if (!handle.free_rotation) return false;
    std::optional<Vec3d> place;
    for (const Index point : *handle.points) {
        if (editor.ordered[point] == no_index) continue;
        const Vec3d at = point_at(editor.opened.opened->positions, editor.ordered[point]);
        if (place && at != *place) return false;
        place = at;
    }
    return true;
}

} // namespace

Transform transform_of(const EditorDrag& drag, const EditorDrag::Along& along) {
    return along.mirror ? seen_in(*along.mirror, drag.transform) : drag.transform;
}

namespace {

std::optional<UnansweredMove> moved_by(const EditorDrag& drag, const std::string& handle) {
    if (drag.handle == handle) return UnansweredMove{drag.motion, transformed(drag.transform, drag.middle)};
    const auto along = std::ranges::find(drag.along, handle, &EditorDrag::Along::handle);
    if (along == drag.along.end()) return std::nullopt;
    return UnansweredMove{along->motion, transformed(transform_of(drag, *along), along->middle)};
}

} // namespace

std::optional<UnansweredMove> unanswered_move(const Editor& editor, const std::string& handle) {
    if (editor.drag)
        if (const auto move = moved_by(*editor.drag, handle)) return move;
    for (auto drag = editor.earlier_drags.rbegin(); drag != editor.earlier_drags.rend(); ++drag)
        if (const auto move = moved_by(*drag, handle)) return move;
    return std::nullopt;
}

glm::dvec3 place_of_gizmo(const Editor& editor, const Handle& handle) {
    if (const auto move = unanswered_move(editor, handle.name)) return move->middle;
    if (const auto pivot = pivot_of(editor, handle.name)) return *pivot;
    if (handle.name == editor.chosen) return editor.handle_middle;
    return middle_of(editor, handle).value_or(glm::dvec3(0.0));
}

std::optional<Gizmo> gizmo_of(const Editor& editor) {
    const Handle* handle = chosen_handle(editor);
    if (!handle || handle->role != HandleRole::moving) return std::nullopt;
    Gizmo gizmo;
    gizmo.local = editor.local_axes;
    const auto number = static_cast<std::size_t>(handle - editor.document->handles.data());
    glm::dquat axes = to_glm(editor.document->motions[number].rotation);
    gizmo.center = place_of_gizmo(editor, *handle);
    if (const auto move = unanswered_move(editor, editor.chosen)) axes = to_glm(move->motion.now.rotation);
    if (editor.local_axes) gizmo.axes = axes;
    if (!pivot_of(editor, editor.chosen)) gizmo.rotate = gizmo.scale = !is_free_place(editor, *handle);
    if (editor.tools.move_pivot) gizmo.rotate = gizmo.scale = false; // arrows alone move it
    return gizmo;
}

std::optional<ChosenPose> pose_of_chosen(const Editor& editor) {
    const std::optional<Gizmo> gizmo = gizmo_of(editor);
    if (!gizmo) return std::nullopt;
    const auto number = static_cast<std::size_t>(chosen_handle(editor) - editor.document->handles.data());
    return ChosenPose{motion_now(editor, number), gizmo->center};
}

HandleMotion motion_now(const Editor& editor, std::size_t handle) {
    const auto move = unanswered_move(editor, editor.document->handles[handle].name);
    return move ? move->motion.now : editor.document->motions[handle];
}

bool is_or_will_be_posed(const Editor& editor) {
    return editor.document->posed || editor.drag || !editor.earlier_drags.empty();
}

std::vector<const SmallPatch*> small_patches(const Editor& editor, const Handle& handle) {
    std::vector<const SmallPatch*> found;
    const std::shared_ptr<const PatchesOfHandles>& small = editor.document->small_patches;
    if (!small || handle.role == HandleRole::region_of_interest) return found;
    for (const SmallPatch& patch : small->patches)
        if (small->points[patch.handle] == handle.points) found.push_back(&patch);
    return found;
}

double least_falloff(const Editor& editor, const Handle& handle) {
    double least = 0;
    for (const SmallPatch* patch : small_patches(editor, handle)) least = std::max(least, patch->falloff);
    return least;
}

Box3 box_of(const Editor& editor) {
    Box3 box = nowhere();
    const LineArray<float>& positions = editor.frame.positions();
    for (std::size_t i = 0; i < positions.size(); i += 3) extend(box, positions.data() + i);
    return positions.empty() ? Box3{} : box;
}

std::optional<Box3> box_of_selection(const Editor& editor) {
    if (editor.selected == 0) return std::nullopt;
    Box3 box = nowhere();
    for (std::size_t i = 0; i < editor.marks.size(); ++i)
        if (editor.marks[i] & mark_selected) extend(box, editor.frame.positions().data() + 3 * i);
    return box;
}

std::optional<Box3> box_of_chosen(const Editor& editor) {
    const Handle* handle = chosen_handle(editor);
    if (!handle) return std::nullopt;
    Box3 box = nowhere();
    bool is_anywhere = false;
    for (const Index i : *handle->points) {
        if (editor.ordered[i] == no_index) continue;
        extend(box, editor.frame.positions().data() + 3 * std::size_t{editor.ordered[i]});
        is_anywhere = true;
    }
    return is_anywhere ? std::optional(box) : std::nullopt;
}

namespace {

bool is_pending(const Editor& editor, const EditorStep& step) {
    const StepNumber done = std::max(editor.document->last_step, step_of_opened_session);
    return std::max(step.document, step.joined) > done;
}

// Whether the document is yet to take something back, or to do a step of which matters(step).
template<typename Matters>
bool is_any_pending(const Editor& editor, Matters&& matters) {
    return editor.live->status().undoing || std::ranges::any_of(editor.past, [&](const EditorStep& step) {
               return matters(step) && is_pending(editor, step);
           });
}

} // namespace

bool has_pending_steps(const Editor& editor) {
    return is_any_pending(editor, [](const EditorStep& /*step*/) { return true; });
}

bool poses_may_change(const Editor& editor) {
    if (!editor.live) return false; // nothing is on its way
    return editor.status.playing ||
           is_any_pending(editor, [](const EditorStep& step) { return !step.is_drag; });
}

bool handles_may_be_elsewhere(const Editor& editor) {
    if (!editor.live || !editor.document) return false;
    // Done by now, and yet to be taken in.
    const bool is_other = editor.live->view()->state != editor.document->state;
    return is_other || is_any_pending(editor, [](const EditorStep& step) {
               return !step.is_drag && !step.settings_changed; // settings move nothing
           });
}

bool has_unsaved_session(const Editor& editor) {
    if (!editor.document) return false;
    // As they are by now, be they taken in or not.
    return has_pending_steps(editor) || editor.live->view()->state != editor.live->saved().session_state;
}

bool looks_back(const Editor& editor) {
    return editor.looks_from && editor.past.size() < *editor.looks_from;
}

bool can_undo(const Editor& editor) {
    const bool dragging = editor.drag && !editor.drag->ended;
    return editor.document && !dragging && !editor.past.empty();
}

bool can_redo(const Editor& editor) {
    const bool dragging = editor.drag && !editor.drag->ended;
    return editor.document && !dragging && !editor.future.empty();
}

std::string way_to_select(SelectTool tool) {
    switch (tool) {
    case SelectTool::click:
        return "click a point of";
    case SelectTool::box:
        return "draw a box round";
    case SelectTool::polygon:
        return "click corners round";
    case SelectTool::brush:
        return "paint over";
    case SelectTool::lasso:
        break;
    }
    return "draw a lasso round";
}

namespace {

// What goes along with the chosen handle while moves are mirrored.
std::string words_about_symmetry(const Editor& editor, const Symmetry& symmetry) {
    const std::size_t mirrored = symmetry.pairs.size();
    const std::size_t all = moved_with(editor, editor.chosen).size() - 1;
    if (all == 0)
        return quoted(editor.chosen) + " moves alone: no moving handle is its counterpart across " +
               "xyz"[symmetry.axis] + ". Mirror makes one.";
    if (all == 1 && mirrored == 1)
        return quoted(symmetry.pairs[0].counterpart) + " does what " + quoted(editor.chosen) +
               " does, mirrored: press G, R or S, or drag the gizmo.";
    return quoted(editor.chosen) + " takes " + counted(all, "handle") + " along, " +
           (mirrored == 0 ? "none" : std::to_string(mirrored)) +
           " of them mirrored: press G, R or S, or drag the gizmo.";
}

} // namespace

std::string next_step(const Editor& editor) {
    if (!editor.document) return {};
    const auto& handles = editor.document->handles;
    const auto has = [&](HandleRole role) {
        return std::ranges::any_of(handles, [&](const Handle& handle) { return handle.role == role; });
    };
    const bool moving = has(HandleRole::moving);
    const bool held = has(HandleRole::fixed) || has(HandleRole::region_of_interest);
    if (editor.selected > 0 && !moving)
        return "Press H to make the selection a handle that moves, or Shift+H one that stays where it is.";
    if (editor.selected > 0 && !held)
        return "Press Shift+H to keep the selection where it is, or H to make it move.";
    std::string select = way_to_select(editor.tools.select);
    if (!moving && !held) select[0] = static_cast<char>(select[0] - 'a' + 'A');
    if (!moving) return (held ? "Now " : "") + select + " the part that should move.";
    if (!held) return "Nothing holds the rest yet: " + select + " what should stay, and press Shift+H.";
    if (editor.selected > 0)
        return std::string("H makes the selection a handle that moves, Shift+H one that stays") +
               (editor.document->posed ? ", and first the pose the new rest shape" : "") +
               "; Esc selects nothing.";
    if (!chosen_handle(editor) || chosen_handle(editor)->role != HandleRole::moving)
        return "Click a moving handle to choose it.";
    if (followers_of(editor, *chosen_handle(editor)) == 0)
        return quoted(editor.chosen) + " moves nothing: handles that were made later hold all of its points.";
    if (editor.tools.move_pivot)
        return "Click where the joint is: the pivot goes inside. Or drag the gizmo's arrows. Press . to move "
               "the handle again.";
    if (editor.symmetry) return words_about_symmetry(editor, *editor.symmetry);
    if (!editor.also_chosen.empty())
        return quoted(editor.chosen) + " takes " + counted(editor.also_chosen.size(), "handle") +
               " along: press G, R or S, or drag the gizmo. A click in the list chooses one alone.";
    if (!editor.document->posed) return "Drag the gizmo, or press G to move, R to turn, S to scale.";
    return "Enter keeps the pose as the new shape.";
}

std::vector<float> displacements(Editor& editor) {
    return displacements(editor.opened.opened->positions, editor.frame.positions(), editor.workers);
}

std::vector<float> local_stretch(Editor& editor) {
    if (!editor.document || !editor.document->graph) return {};
    return local_stretch(*editor.opened.order, *editor.document->graph, editor.opened.opened->positions,
                         editor.frame.positions(), editor.workers);
}

} // namespace knead

// How the editor poses handles: by dragging, taking them back, and mirroring.

#include "base/quoted.h"
#include "edit/editor_steps.h"
#include "edit/handle_lines.h"
#include "edit/handle_motion.h"
#include "edit/mirroring.h"
#include "edit/pose_numbers.h"

#include <algorithm>
#include <cstdio>
#include <iterator>

namespace knead {

namespace {

std::string words_about(const MirrorPlane& plane, double place) {
    char text[64];
    std::snprintf(text, sizeof text, "%c = %.4g", "xyz"[plane.axis], place);
    return text + std::string(plane.is_middle ? ", the middle of the cloud"
                                              : ", where the cloud is most like its mirror image");
}

std::size_t common_points(const std::vector<Index>& a, const std::vector<Index>& b) { // both ascend
    std::vector<Index> both;
    std::ranges::set_intersection(a, b, std::back_inserter(both));
    return both.size();
}

// Whether a good part of these are the same points. The shape that a handle was mirrored in may have been
// bent since, and the plane lie elsewhere.
bool are_alike(const std::vector<Index>& a, const std::vector<Index>& b) {
    return 4 * common_points(a, b) > std::max(a.size(), b.size());
}

// The moving handle that holds most of these points, where they are about its own and it shares fewer with
// the one that is mirrored; null without one.
const Handle* moving_handle_at(const Editor& editor, const Handle& mirrored,
                               const std::vector<Index>& points) {
    const Handle* found = nullptr;
    std::size_t most = 0;
    for (const Handle& other : editor.document->handles) {
        if (other.name == mirrored.name || other.role != HandleRole::moving) continue;
        const std::size_t common = common_points(*other.points, points);
        if (common <= most || !are_alike(*other.points, points)) continue;
        if (common <= common_points(*other.points, *mirrored.points)) continue;
        most = common;
        found = &other;
    }
    return found;
}

// The line of a mirrored handle that is to be made. Mirrored once more to where it was mirrored before, and
// no moving one is since, it is the one that was made then.
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

// Where a handle's pivot goes when it leaves one motion for another; nothing: it has none of its own.
std::optional<Vec3d> pivot_after(const Editor& editor, const std::string& handle, const HandleMotion& before,
                                 const HandleMotion& after) {
    const auto pivot = pivot_of(editor, handle);
    if (!pivot) return std::nullopt;
    return moved_on(to_eigen(*pivot), before, after);
}

} // namespace

void carry_out(Editor& editor, const ResetPoses& command) {
    std::vector<std::string> handles = command.handles;
    std::erase_if(handles, [&](const std::string& name) {
        const auto number = number_of(editor, name);
        return !will_be_there(editor, name) ||
               (number && editor.document->handles[*number].role != HandleRole::moving);
    });
    if (handles.empty() || !is_or_will_be_posed(editor)) return;
    EditorStep step = coming_step(editor, ++editor.last_step);
    editor.live->reset_poses(step.document, handles);
    add_step(editor, std::move(step));
    for (const std::string& name : handles) {
        const auto pivot = pivot_of(editor, name);
        const auto number = number_of(editor, name);
        if (!pivot || !number) continue;
        const Vec3d at_rest = point_at_rest(motion_now(editor, *number), to_eigen(*pivot));
        put_pivot_with(editor.past.back(), editor, name, to_glm(at_rest));
    }
}

namespace {

// By less of the diagonal, a handle was not moved: its middle is known as closely as floats tell.
constexpr double rounding = 1e-6;

// The frames of a drag that takes a part of a pose back; none where there is nothing to take back.
std::vector<HandleMotion> frames_back(PosePart part, const HandleMotion& motion, const Vec3d& pivot,
                                      double diagonal) {
    if (part == PosePart::turn) return unturned(motion, pivot);
    const Transform back = part == PosePart::scaling ? unscaled(motion, pivot) : unmoved(motion, pivot);
    const bool is_less = part == PosePart::move && glm::length(back.shift) <= rounding * diagonal;
    if (is_less || does_nothing(back)) return {};
    return {followed_by(motion, back)};
}

} // namespace

// Each goes back by itself, about its own pivot.
void carry_out(Editor& editor, const TakeBackPart& command) {
    if (!needs_document(editor) || poses_may_change(editor)) return;
    const Vec3d& origin = editor.opened.cloud->origin;
    std::vector<SessionAction> lines;
    std::vector<PivotMove> pivots;
    for (const std::string& name : command.handles) {
        const auto number = number_of(editor, name);
        if (!number || !will_be_there(editor, name)) continue;
        const Handle& handle = editor.document->handles[*number];
        if (handle.role != HandleRole::moving) continue;
        const glm::dvec3 pivot = place_of_gizmo(editor, handle);
        const HandleMotion motion = motion_now(editor, *number);
        const std::vector<HandleMotion> frames =
            frames_back(command.part, motion, to_eigen(pivot), editor.opened.bounds.diagonal());
        if (frames.empty()) continue;
        DragLine line{name, to_eigen(pivot) + origin, {}};
        for (const HandleMotion& frame : frames) line.frames.push_back(pose_of(frame, line.pivot, origin));
        lines.emplace_back(std::move(line));
        if (pivot_of(editor, name))
            pivots.push_back({name, pivot, to_glm(moved_on(to_eigen(pivot), motion, frames.back()))});
    }
    if (lines.empty()) return;
    post_step(editor, std::move(lines));
    for (const PivotMove& move : pivots) put_pivot_with(editor.past.back(), editor, move.handle, move.after);
}

namespace {

// What a handle becomes on the other side.
struct MirroredHandle {
    HandleLine line;
    std::optional<Vec3d> pivot; // where it is when all is done; nothing: in the middle
};

// `twin`: the handle that is there already; null: none.
MirroredHandle mirrored_handle(const Editor& editor, const Handle& handle, const HandleMotion& motion,
                               const Handle* twin, const std::vector<Index>& points,
                               const Reflection& mirror) {
    MirroredHandle there{twin ? line_of(*twin) : line_of_mirrored(editor, handle, points), {}};
    if (twin && twin->pivot) {
        const HandleMotion before = motion_now(editor, *number_of(editor, twin->name));
        there.pivot = pivot_after(editor, twin->name, before, seen_in(mirror, motion));
        return there;
    }
    there.line.pivot.reset();
    if (const auto own = pivot_of(editor, handle.name)) {
        const Vec3d at_rest = point_at_rest(motion, to_eigen(*own));
        there.pivot = seen_in(mirror, to_eigen(*own));
        there.line.pivot = seen_in(mirror, at_rest) + editor.opened.cloud->origin;
    }
    return there;
}

// The words about a handle without a pose.
void tell_of_no_pose(Editor& editor, const Handle& handle, bool has_twin) {
    say(editor, Notice::Kind::information,
        (has_twin ? "There is no pose to mirror: " : "Only the handle was mirrored: ") + quoted(handle.name) +
            " is where it was at rest" + (has_twin ? "." : ", so there is no pose to mirror."));
}

void post_posed(Editor& editor, HandleLine line, PoseOfAnother pose) {
    EditorStep step = coming_step(editor, ++editor.last_step);
    editor.live->make_posed(step.document, std::move(line), std::move(pose));
    add_step(editor, std::move(step));
}

} // namespace

void carry_out(Editor& editor, const MirrorHandle& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    const Handle& handle = editor.document->handles[*number];
    const std::span<const float> positions = rest_positions(editor);
    // Moves on both sides go on from the handle that was chosen, posed or not, across the plane that is seen.
    const bool stays =
        editor.symmetry && editor.symmetry->axis == command.axis && editor.chosen == handle.name;
    const MirrorPlane plane = stays ? MirrorPlane{command.axis, editor.symmetry->at, false}
                                    : mirror_plane(positions, command.axis, editor.opened.spacing);
    const PartAcross across =
        part_across({positions, editor.ordered}, *handle.points, plane, 3 * editor.opened.spacing);
    const double place = plane.at + editor.opened.cloud->origin[command.axis];
    if (across.points.empty())
        return say(editor, Notice::Kind::error,
                   "There is nothing across " + words_about(plane, place) + ", where " + quoted(handle.name) +
                       " would be mirrored to.");
    if (!plane.is_middle && !stays)
        say(editor, Notice::Kind::information, "Mirrored across " + words_about(plane, place) + ".");
    const bool moves = handle.role == HandleRole::moving;
    const HandleMotion motion = motion_now(editor, *number);
    const bool is_posed = moves && leaves_rest(motion);
    const Handle* const twin = moves ? moving_handle_at(editor, handle, across.points) : nullptr;
    if (moves && !is_posed && (twin || !stays)) tell_of_no_pose(editor, handle, twin != nullptr);
    if (twin && !is_posed) return stays ? void() : choose(editor, twin->name);

    const Reflection mirror = reflection(plane, across.shift);
    auto [line, pivot] = mirrored_handle(editor, handle, motion, twin, across.points, mirror);
    const std::string name = line.name;
    if (is_posed)
        post_posed(editor, std::move(line),
                   {handle.name, [=](const HandleMotion& seen) { return seen_in(mirror, seen); }});
    else
        post_step(editor, {std::move(line)});
    put_pivot_with(editor.past.back(), editor, name, pivot ? std::optional(to_glm(*pivot)) : std::nullopt);
    editor.posted_names.emplace_back(editor.last_step, name);
    if (stays)
        find_counterparts(editor);
    else
        choose_with_step(editor, name);
}

// --- Dragging ---

void forget_drag(Editor& editor, StepNumber step) {
    if (editor.drag && editor.drag->step == step) editor.drag.reset();
    std::erase_if(editor.earlier_drags, [&](const EditorDrag& drag) { return drag.step == step; });
}

namespace {

// As the document is told of those that go along. Of some it will know the names before the editor does; how
// they would be mirrored is not known then, and where moves are, they stay.
std::vector<Companion> companions(const Editor& editor, const EditorDrag& drag, const glm::dvec3& pivot) {
    std::vector<Companion> companions;
    for (const EditorDrag::Along& along : drag.along) {
        companions.push_back({along.handle});
        if (along.mirror)
            companions.back().mirror = {along.mirror->normal, seen_in(*along.mirror, to_eigen(pivot)) +
                                                                  editor.opened.cloud->origin};
    }
    for (const std::string& other : editor.also_chosen)
        if (!editor.symmetry && !number_of(editor, other)) companions.push_back({other});
    return companions;
}

} // namespace

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
    drag.along = handles_along(editor, command.pivot);
    EditorStep step = coming_step(editor, drag.step);
    step.is_drag = true;
    editor.live->begin_drag(drag.step, editor.chosen, to_eigen(command.pivot) + editor.opened.cloud->origin,
                            companions(editor, drag, command.pivot));
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
    for (EditorDrag::Along& along : editor.drag->along)
        carry_on(along.motion, transform_of(*editor.drag, along));
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
    for (const EditorDrag::Along& along : editor.drag->along)
        if (const auto pivot = pivot_of(editor, along.handle); pivot && step != editor.past.end())
            put_pivot_with(*step, editor, along.handle,
                           transformed(transform_of(*editor.drag, along), *pivot));
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

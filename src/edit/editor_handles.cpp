// What the editor does to handles: making, changing, mirroring and dragging them.

#include "edit/editor_steps.h"
#include "edit/way_back.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

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

std::vector<IndexRange> ranges_of(const std::vector<Index>& points) {
    std::vector<IndexRange> ranges;
    for (const Index i : points) append_point(ranges, i);
    return ranges;
}

bool is_free(const Editor& editor, const std::string& name) {
    return !number_of(editor, name) && std::ranges::none_of(editor.posted_names, [&](const auto& posted) {
        return posted.second == name;
    });
}

// As the session file declares it.
HandleLine line_of(const Handle& handle) {
    HandleLine line;
    line.name = handle.name;
    line.role = handle.role;
    line.points = ranges_of(*handle.points);
    line.free_rotation = handle.free_rotation;
    line.falloff = handle.falloff;
    return line;
}

bool share_points(const Handle& a, const Handle& b) {
    auto at = a.points->begin();
    for (const Index point : *b.points) { // both ascend
        at = std::lower_bound(at, a.points->end(), point);
        if (at == a.points->end()) return false;
        if (*at == point) return true;
    }
    return false;
}

// Declares a handle anew. That makes it the last one, and the last one has what several hold: so those that
// came later and share points with it come again after it, and with them all that came later.
void change_handle(Editor& editor, std::size_t number, HandleLine line) {
    const std::span<const Handle> handles = editor.document->handles;
    const std::span<const Handle> later = handles.subspan(number + 1);
    std::vector<SessionAction> lines{std::move(line)};
    if (std::ranges::any_of(later, [&](const Handle& one) { return share_points(handles[number], one); }))
        for (const Handle& handle : later) lines.emplace_back(line_of(handle));
    post_step(editor, std::move(lines));
}

} // namespace

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
                   "Select the points of the handle first: draw a lasso round them.");
    HandleLine line;
    line.name = command.name.empty() ? free_name(editor, command.role) : command.name;
    line.role = command.role;
    line.points = selected_ranges(editor.marks, *editor.opened.order, editor.opened.cloud->size());
    auto before = snapshot(editor);
    select_none(editor.marks, editor.workers);
    marks_changed(editor);
    const std::string name = line.name;
    const StepNumber step = post_step(editor, {std::move(line)}, std::move(before));
    editor.posted_names.emplace_back(step, name);
    if (command.role == HandleRole::moving) choose_with_step(editor, name);
}

void carry_out(Editor& editor, const ChooseHandle& command) {
    editor.pivot.reset();
    choose(editor, command.handle);
}

void carry_out(Editor& editor, const RenameHandle& command) {
    if (!number_of(editor, command.handle) || command.to.empty() || command.to == command.handle) return;
    if (number_of(editor, command.to))
        return say(editor, Notice::Kind::error, "There is a handle \"" + command.to + "\" already.");
    const StepNumber step = post_step(editor, {RenameLine{command.handle, command.to}});
    editor.posted_names.emplace_back(step, command.to);
    if (editor.chosen == command.handle) choose_with_step(editor, command.to);
}

void carry_out(Editor& editor, const ChangeRole& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    const Handle& handle = editor.document->handles[*number];
    if (handle.role == command.role) return;
    HandleLine line = line_of(handle);
    line.role = command.role;
    if (command.role == HandleRole::region_of_interest) {
        line.free_rotation = false;
        line.falloff = 0;
    }
    change_handle(editor, *number, std::move(line));
}

void carry_out(Editor& editor, const ChangeHold& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    const Handle& handle = editor.document->handles[*number];
    const bool is_new = handle.free_rotation != command.free_rotation || handle.falloff != command.falloff;
    if (!is_new || handle.role == HandleRole::region_of_interest) return;
    HandleLine line = line_of(handle);
    line.free_rotation = command.free_rotation;
    line.falloff = command.falloff;
    change_handle(editor, *number, std::move(line));
}

void carry_out(Editor& editor, const DeleteHandle& command) {
    if (number_of(editor, command.handle)) post_step(editor, {DeleteLine{command.handle}});
}

void carry_out(Editor& editor, const SelectHandlePoints& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    std::vector<std::uint8_t> inside(editor.marks.size(), 0);
    for (const Index i : *editor.document->handles[*number].points)
        if (editor.ordered[i] != no_index) inside[editor.ordered[i]] = 1;
    auto before = snapshot(editor);
    select(editor.marks, inside, command.mode, editor.workers);
    if (*before == *snapshot(editor)) return;
    marks_changed(editor);
    add_step(editor, 0, std::move(before));
}

// --- Poses that are not dragged ----------------------------------------------------------------------------

namespace {

// A drag from rest to a motion in even steps, about the middle of the handle.
DragLine drag_towards(const std::string& handle, const HandleMotion& motion, const Vec3d& middle,
                      const Vec3d& origin) {
    const Vec3d to = motion.linear * middle + motion.offset;
    const Eigen::AngleAxisd turn(motion.rotation);
    const int steps = std::max(1, static_cast<int>(std::ceil(std::abs(turn.angle()) / widest_turn)));
    const HandlePose last = pose_of(motion, middle + origin, origin);
    DragLine line{handle, middle + origin, {}};
    for (int k = 1; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        HandlePose pose = last;
        pose.translate = t * (to - middle);
        pose.rotate = Quatd(Eigen::AngleAxisd(t * turn.angle(), turn.axis()));
        pose.scale = Vec3d::Ones() + t * (last.scale - Vec3d::Ones());
        line.frames.push_back(pose);
    }
    line.frames.back() = last;
    return line;
}

// The motion seen in a mirror: p → F M(F p), with F the reflection across a plane x_axis = at.
HandleMotion mirrored(const HandleMotion& motion, int axis, double at) {
    Mat3d flip = Mat3d::Identity();
    flip(axis, axis) = -1;
    Vec3d shift = Vec3d::Zero();
    shift[axis] = 2 * at;
    HandleMotion result;
    result.linear = flip * motion.linear * flip;
    result.offset = flip * (motion.linear * shift + motion.offset) + shift;
    Vec3d turn = -(flip * motion.rotation.vec()); // an axial vector
    result.rotation = Quatd(motion.rotation.w(), turn.x(), turn.y(), turn.z());
    return result;
}

using Cell = std::array<std::int64_t, 3>;
struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::size_t hash = 0;
        for (const std::int64_t c : cell) hash = hash * 0x9e3779b97f4a7c15U + static_cast<std::size_t>(c);
        return hash;
    }
};

// Points of the shape as opened in cells of the size `reach`, with whether they belong to a handle.
struct PointGrid {
    struct Entry {
        Vec3d place;
        bool in_handle = false;
    };
    double reach = 1;
    std::unordered_map<Cell, std::vector<Entry>, CellHash> cells;

    Cell cell_of(const Vec3d& p) const {
        const auto along = [&](int axis) { return static_cast<std::int64_t>(std::floor(p[axis] / reach)); };
        return {along(0), along(1), along(2)};
    }
    // Whether the nearest point, if there is one within reach, belongs to the handle.
    bool nearest_is_in_handle(const Vec3d& p) const {
        const Cell cell = cell_of(p);
        double nearest = reach * reach;
        bool in_handle = false;
        for (int k = 0; k < 27; ++k) {
            const auto found =
                cells.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
            if (found == cells.end()) continue;
            for (const Entry& entry : found->second) {
                const double distance = (entry.place - p).squaredNorm();
                if (distance >= nearest) continue;
                nearest = distance;
                in_handle = entry.in_handle;
            }
        }
        return in_handle;
    }
};

// The file's points whose mirror image lies nearest to a point of the handle, in the shape as opened; nothing
// farther off than `reach` counts.
std::vector<Index> points_across(const Editor& editor, const Handle& handle, int axis, double at,
                                 double reach) {
    const std::vector<float>& rest = editor.opened.opened->positions;
    const auto place = [&](Index i) { return point_at(rest, editor.ordered[i]); };
    std::vector<bool> in_handle(editor.ordered.size(), false);
    Eigen::AlignedBox3d box;
    for (const Index i : *handle.points) {
        if (editor.ordered[i] == no_index) continue;
        in_handle[i] = true;
        box.extend(place(i));
    }
    box.min().array() -= 2 * reach;
    box.max().array() += 2 * reach;

    PointGrid grid{reach, {}};
    for (Index i = 0; i < editor.ordered.size(); ++i)
        if (editor.ordered[i] != no_index && box.contains(place(i)))
            grid.cells[grid.cell_of(place(i))].push_back({place(i), in_handle[i]});
    std::vector<Index> points;
    for (Index i = 0; i < editor.ordered.size(); ++i) {
        if (editor.ordered[i] == no_index) continue;
        Vec3d p = place(i);
        p[axis] = 2 * at - p[axis];
        if (box.contains(p) && grid.nearest_is_in_handle(p)) points.push_back(i);
    }
    return points;
}

// Mirrored once more to where it was mirrored before, it takes the place of what that made.
std::string name_of_mirrored(const Editor& editor, const Handle& handle, const std::vector<Index>& points) {
    for (unsigned number = 1;; ++number) {
        std::string name = handle.name + " mirrored" + (number > 1 ? " " + std::to_string(number) : "");
        const auto there = number_of(editor, name);
        if (is_free(editor, name) || (there && *editor.document->handles[*there].points == points))
            return name;
    }
}

Vec3d rest_middle(const Editor& editor, const std::vector<Index>& points) {
    Vec3d sum = Vec3d::Zero();
    std::size_t count = 0;
    for (const Index i : points) {
        if (editor.ordered[i] == no_index) continue;
        sum += point_at(editor.opened.opened->positions, editor.ordered[i]);
        ++count;
    }
    return count > 0 ? Vec3d(sum / static_cast<double>(count)) : sum;
}

} // namespace

void carry_out(Editor& editor, const ResetPose& command) {
    const auto number = number_of(editor, command.handle);
    if (!number || editor.document->handles[*number].role != HandleRole::moving) return;
    if (!editor.document->posed) return;
    editor.live->reset_pose(++editor.last_step, command.handle);
    add_step(editor, editor.last_step, nullptr);
}

void carry_out(Editor& editor, const MirrorHandle& command) {
    const auto number = number_of(editor, command.handle);
    if (!number) return;
    const Handle& handle = editor.document->handles[*number];
    const Vec3d middle = 0.5 * (editor.opened.bounds.lowest + editor.opened.bounds.highest);
    const double at = middle[command.axis] - editor.opened.cloud->origin[command.axis];
    const std::vector<Index> points =
        points_across(editor, handle, command.axis, at, 3 * editor.opened.spacing);
    if (points.empty())
        return say(editor, Notice::Kind::error,
                   "There is nothing across the middle of the cloud where \"" + handle.name +
                       "\" would be mirrored to.");
    HandleLine line = line_of(handle);
    line.name = name_of_mirrored(editor, handle, points);
    line.points = ranges_of(points);
    const std::string name = line.name;
    std::vector<SessionAction> lines{std::move(line)};
    const HandleMotion& pose = editor.document->motions[*number];
    const bool is_posed = pose.linear != Mat3d::Identity() || pose.offset != Vec3d::Zero();
    if (is_posed && handle.role == HandleRole::moving) {
        const HandleMotion motion = mirrored(pose, command.axis, at);
        lines.emplace_back(
            drag_towards(name, motion, rest_middle(editor, points), editor.opened.cloud->origin));
    } else if (handle.role == HandleRole::moving) {
        say(editor, Notice::Kind::information,
            "Only the handle was mirrored: \"" + handle.name +
                "\" is where it was at rest, so there is no pose to mirror.");
    }
    editor.posted_names.emplace_back(post_step(editor, std::move(lines)), name);
    choose_with_step(editor, name);
}

// --- Dragging ---

void carry_out(Editor& editor, const BeginDrag& command) {
    const auto number = number_of(editor, editor.chosen);
    if (!number || editor.document->handles[*number].role != HandleRole::moving) return;
    const std::optional<Gizmo> gizmo = gizmo_of(editor);
    EditorDrag drag;
    drag.step = ++editor.last_step;
    drag.middle = gizmo ? gizmo->center : command.pivot;
    drag.local_axes = to_glm(editor.document->motions[*number].rotation);
    if (editor.drag) // the last one is not answered yet
        drag.local_axes = glm::angleAxis(editor.drag->transform.angle, editor.drag->transform.axis) *
                          editor.drag->local_axes;
    drag.future = std::move(editor.future);
    editor.drag = std::move(drag);
    editor.live->begin_drag(editor.last_step, editor.chosen,
                            to_eigen(command.pivot) + editor.opened.cloud->origin);
    add_step(editor, editor.last_step, nullptr);
}

void carry_out(Editor& editor, const DragTo& command) {
    if (!editor.drag || editor.drag->ended) return;
    editor.drag->transform = command.transform;
    editor.live->drag_to(command.transform);
}

void carry_out(Editor& editor, const EndDrag& /*command*/) {
    if (!editor.drag || editor.drag->ended) return;
    editor.drag->ended = true;
    editor.handle_middle = transformed(editor.drag->transform, editor.drag->middle);
    if (editor.pivot) editor.pivot = editor.handle_middle;
    editor.live->end_drag();
}

void carry_out(Editor& editor, const CancelDrag& /*command*/) {
    if (!editor.drag || editor.drag->ended) return;
    if (!editor.past.empty() && editor.past.back().document == editor.drag->step) {
        editor.past.pop_back();
        editor.future = std::move(editor.drag->future);
    }
    editor.drag.reset();
    editor.live->cancel_drag();
}

void carry_out(Editor& editor, const SetPivot& command) {
    editor.pivot = command.pivot;
}

} // namespace knead

// How the editor moves handles on both sides of the cloud at once.

#include "edit/editor_steps.h"
#include "edit/mirroring.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

// Two handles of which the one is so many times as large as the other are not counterparts.
constexpr double most_times_as_large = 2;

// So many points tell where a handle is, and how large.
constexpr std::size_t enough_points = 500;

MirrorPlane plane_of(const Symmetry& symmetry) {
    return {symmetry.axis, symmetry.at, false};
}

// A moving handle in the shape as it was opened.
struct Place {
    const Handle* handle = nullptr;
    Vec3d middle = Vec3d::Zero();
    double size = 0; // the usual distance of its points from there
};

std::optional<Place> place_of(const Editor& editor, const Handle& handle) {
    const std::vector<Index>& points = *handle.points;
    const std::size_t stride = std::max<std::size_t>(1, points.size() / enough_points);
    Place place{&handle};
    double squares = 0, count = 0;
    for (std::size_t k = 0; k < points.size(); k += stride) {
        const Index i = editor.ordered[points[k]];
        if (i == no_index) continue;
        const Vec3d point = point_at(editor.opened.opened->positions, i);
        place.middle += point;
        squares += point.squaredNorm();
        ++count;
    }
    if (count == 0) return std::nullopt;
    place.middle /= count;
    place.size = std::sqrt(std::max(0.0, squares / count - place.middle.squaredNorm()));
    return place;
}

// Of those that move, and will still be there by that name when the document hears of it.
std::vector<Place> places_of(const Editor& editor) {
    std::vector<Place> places;
    for (const Handle& handle : editor.document->handles)
        if (handle.role == HandleRole::moving && will_be_there(editor, handle.name))
            if (const auto place = place_of(editor, handle)) places.push_back(*place);
    return places;
}

bool are_about_as_large(const Place& a, const Place& b) {
    return std::max(a.size, b.size) <= most_times_as_large * std::min(a.size, b.size);
}

// Of those on the other side that are about as large, the one nearest to the mirror image of this one; null:
// there is none. It may be as far off as the plane, and as the two are wide, as the legs of what walks are;
// but not as far as this one itself: what lies about on the plane, as head and neck do, has none.
const Place* nearest_across(const std::vector<Place>& places, const Place& place, const MirrorPlane& plane) {
    const auto side = [&](const Place& of) { return of.middle[plane.axis] - plane.at; };
    const Vec3d image = seen_in(reflection(plane, Vec3d::Zero()), place.middle);
    const double aside = std::abs(side(place));
    const Place* nearest = nullptr;
    for (const Place& other : places) {
        if (side(other) * side(place) >= 0 || !are_about_as_large(place, other)) continue;
        const double reach = std::min(2 * aside, aside + place.size + other.size);
        const double distance = (other.middle - image).norm();
        if (distance < reach && (!nearest || distance < (nearest->middle - image).norm())) nearest = &other;
    }
    return nearest;
}

// Two handles, of which each is the nearest across to the other: fingers of a hand have those of the other.
const Place* counterpart(const std::vector<Place>& places, const Place& place, const MirrorPlane& plane) {
    const Place* other = nearest_across(places, place, plane);
    return other && nearest_across(places, *other, plane) == &place ? other : nullptr;
}

using Pair = Symmetry::Pair;

// Of what is chosen, what has a counterpart. Where both are chosen, the one that was first leads.
std::vector<Pair> chosen_pairs(const Editor& editor) {
    std::vector<Pair> pairs;
    if (!editor.symmetry || editor.chosen.empty() || !editor.document) return pairs;
    const std::vector<Place> places = places_of(editor);
    for (const std::string& name : chosen_with(editor, editor.chosen)) {
        if (std::ranges::find(pairs, name, &Pair::counterpart) != pairs.end()) continue;
        const auto place = std::ranges::find(places, name, [](const Place& of) { return of.handle->name; });
        if (place == places.end()) continue; // it is held, or has yet to get this name
        const Place* other = counterpart(places, *place, plane_of(*editor.symmetry));
        if (other) pairs.push_back({name, other->handle->name});
    }
    return pairs;
}

const Handle& handle_of_document(const Editor& editor, const std::string& name) {
    return editor.document->handles[*number_of(editor, name)];
}

// Where a place that goes with the one handle has its like on the other, both as they are now: that lies
// across at rest, as far off the mirror image as the middles of the two are.
Vec3d place_across(const Editor& editor, const Pair& pair, const Vec3d& place) {
    const auto at_rest = [&](const std::string& name) {
        return middle_in(rest_positions(editor), editor, handle_of_document(editor, name))
            .value_or(Vec3d::Zero());
    };
    const Reflection mirror =
        reflection(Vec3d::Unit(editor.symmetry->axis), at_rest(pair.handle), at_rest(pair.counterpart));
    const HandleMotion one = motion_now(editor, *number_of(editor, pair.handle));
    const HandleMotion other = motion_now(editor, *number_of(editor, pair.counterpart));
    return moved_point(other, seen_in(mirror, point_at_rest(one, place)));
}

// What shows turns of the one about `pivot` as turns of the other: about that one's own joint where the user
// gave both of them one.
Reflection mirror_between(const Editor& editor, const Pair& pair, const Vec3d& pivot) {
    const bool have_joints = pivot_of(editor, pair.handle) && pivot_of(editor, pair.counterpart);
    const Vec3d there = have_joints
                            ? to_eigen(place_of_gizmo(editor, handle_of_document(editor, pair.counterpart)))
                            : place_across(editor, pair, pivot);
    return reflection(Vec3d::Unit(editor.symmetry->axis), pivot, there);
}

} // namespace

void find_counterparts(Editor& editor) {
    if (editor.symmetry) editor.symmetry->pairs = chosen_pairs(editor);
}

bool goes_mirrored(const Editor& editor, const std::string& handle) {
    return editor.symmetry && std::ranges::find(editor.symmetry->pairs, handle, &Pair::counterpart) !=
                                  editor.symmetry->pairs.end();
}

std::vector<std::string> moved_with(const Editor& editor, const std::string& handle) {
    std::vector<std::string> handles = chosen_with(editor, handle);
    if (!editor.symmetry || std::ranges::find(handles, editor.chosen) == handles.end()) return handles;
    for (const Pair& pair : editor.symmetry->pairs)
        if (std::ranges::find(handles, pair.counterpart) == handles.end())
            handles.push_back(pair.counterpart);
    return handles;
}

std::optional<JointAcross> joint_across(const Editor& editor, const std::string& handle,
                                        const glm::dvec3& pivot) {
    if (!editor.symmetry) return std::nullopt;
    const auto pair = std::ranges::find(editor.symmetry->pairs, handle, &Pair::handle);
    if (pair == editor.symmetry->pairs.end()) return std::nullopt;
    return JointAcross{pair->counterpart, to_glm(place_across(editor, *pair, to_eigen(pivot)))};
}

std::vector<EditorDrag::Along> handles_along(const Editor& editor, const glm::dvec3& pivot) {
    std::vector<EditorDrag::Along> along;
    const auto add = [&](const std::string& name, const std::optional<Reflection>& mirror) {
        const auto number = number_of(editor, name);
        if (!number) return; // it has yet to get this name
        const HandleMotion now = motion_now(editor, *number);
        along.push_back(
            {name, place_of_gizmo(editor, editor.document->handles[*number]), {now, now}, mirror});
    };
    for (const std::string& other : editor.also_chosen)
        if (!goes_mirrored(editor, other)) add(other, std::nullopt);
    if (!editor.symmetry) return along;
    // Of all of them, which turn about one pivot.
    Reflection mirror = reflection(plane_of(*editor.symmetry), Vec3d::Zero());
    for (const Pair& pair : editor.symmetry->pairs) {
        if (pair.handle == editor.chosen) mirror = mirror_between(editor, pair, to_eigen(pivot));
        add(pair.counterpart, mirror);
    }
    return along;
}

void carry_out(Editor& editor, const MirrorMoves& command) {
    if (!command.axis || !needs_document(editor)) return editor.symmetry.reset();
    const MirrorPlane plane =
        mirror_plane(editor.opened.opened->positions, *command.axis, editor.opened.spacing);
    editor.symmetry = {*command.axis, plane.at, {}};
    find_counterparts(editor);
}

} // namespace knead

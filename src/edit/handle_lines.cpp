#include "edit/handle_lines.h"

#include "base/quoted.h"

#include <algorithm>
#include <iterator>

namespace knead {

namespace {

bool share_points(const Handle& a, const Handle& b) {
    auto at = a.points->begin();
    for (const Index point : *b.points) { // both ascend
        at = std::lower_bound(at, a.points->end(), point);
        if (at == a.points->end()) return false;
        if (*at == point) return true;
    }
    return false;
}

std::vector<Index> points_in(const std::vector<IndexRange>& ranges) {
    std::vector<Index> points;
    for (const IndexRange& range : ranges)
        for (std::uint64_t i = range.first; i <= range.last; ++i) points.push_back(static_cast<Index>(i));
    return points;
}

std::vector<Index> without(const std::vector<Index>& points, const std::vector<Index>& gone) {
    std::vector<Index> left;
    std::ranges::set_difference(points, gone, std::back_inserter(left));
    return left;
}

// What follows a handle: of the points that it declares, those that no later one does.
std::vector<Index> own_points(const Handle& handle, std::span<const Handle> later) {
    std::vector<Index> own = *handle.points;
    if (handle.role == HandleRole::region_of_interest) return own;
    for (const Handle& other : later)
        if (other.role != HandleRole::region_of_interest) own = without(own, *other.points);
    return own;
}

// What a handle declares then.
std::vector<Index> assigned(const HandleEdit::Points& edit, const Handle& handle,
                            const std::vector<Index>& own) {
    std::vector<Index> chosen = points_in(edit.chosen);
    if (edit.mode == SelectMode::replace) return chosen;
    if (edit.mode == SelectMode::remove) return without(*handle.points, chosen);
    std::vector<Index> both;
    std::ranges::set_union(own, chosen, std::back_inserter(both));
    return both;
}

Handle with_points(Handle handle, std::span<const Handle> later, const HandleEdit::Points& edit) {
    const std::vector<Index> own = own_points(handle, later);
    std::vector<Index> points = assigned(edit, handle, own);
    // What it declares and a later one has, it is given back only by being declared anew.
    const bool takes_back = edit.mode != SelectMode::remove;
    if (!points.empty() && points != own && (takes_back || points != *handle.points))
        handle.points = std::make_shared<const std::vector<Index>>(std::move(points));
    return handle;
}

Handle edited(const Handle& before, std::span<const Handle> later, const HandleEdit& edit) {
    Handle handle = edit.points ? with_points(before, later, *edit.points) : before;
    if (edit.role) handle.role = *edit.role;
    if (edit.hold) {
        handle.free_rotation = edit.hold->free_rotation;
        handle.falloff = edit.hold->falloff;
    }
    if (handle.role == HandleRole::region_of_interest) {
        handle.free_rotation = false;
        handle.falloff = 0;
    }
    if (edit.color) handle.color = edit.color->rgb;
    if (edit.pivot) handle.pivot = edit.pivot->at_rest;
    return handle;
}

} // namespace

std::vector<IndexRange> ranges_of(const std::vector<Index>& points) {
    std::vector<IndexRange> ranges;
    for (const Index i : points) append_point(ranges, i);
    return ranges;
}

HandleLine line_of(const Handle& handle) {
    HandleLine line;
    line.name = handle.name;
    line.role = handle.role;
    line.points = ranges_of(*handle.points);
    line.free_rotation = handle.free_rotation;
    line.falloff = handle.falloff;
    line.color = handle.color;
    line.pivot = handle.pivot;
    return line;
}

bool changes(std::span<const Handle> handles, const HandleEdit& edit) {
    const auto number = number_of(handles, edit.handle);
    if (!number) return false;
    const Handle& before = handles[*number];
    const Handle after = edited(before, handles.subspan(*number + 1), edit);
    return !holds_the_same(before, after) || after.color != before.color || after.pivot != before.pivot;
}

std::vector<SessionAction> lines_for(std::span<const Handle> handles, const HandleEdit& edit) {
    if (!changes(handles, edit)) return {};
    const std::size_t number = *number_of(handles, edit.handle);
    const Handle& before = handles[number];
    const std::span<const Handle> later = handles.subspan(number + 1);
    const Handle after = edited(before, later, edit);
    std::vector<SessionAction> lines{line_of(after)};
    const bool takes = edit.points && edit.points->mode != SelectMode::remove;
    const auto shares = [&](const Handle& one) { return share_points(before, one); };
    if (!takes && !holds_the_same(before, after) && std::ranges::any_of(later, shares))
        for (const Handle& handle : later) lines.emplace_back(line_of(handle));
    return lines;
}

std::string words_about(const HandleLine& line, std::span<const Handle> handles) {
    const std::string name = quoted(line.name);
    const Handle* const found = handle_named(handles, line.name);
    if (!found)
        return (line.role == HandleRole::moving  ? "new moving handle "
                : line.role == HandleRole::fixed ? "new fixed handle "
                                                 : "new region of interest ") +
               name;
    const auto are_equal = [](const IndexRange& a, const IndexRange& b) {
        return a.first == b.first && a.last == b.last;
    };
    // Nobody has looked yet at how many points they claim to be.
    const auto* ranges = std::get_if<std::vector<IndexRange>>(&line.points);
    const bool holds_the_same = ranges && std::ranges::equal(*ranges, ranges_of(*found->points), are_equal) &&
                                line.role == found->role && line.free_rotation == found->free_rotation &&
                                line.falloff == found->falloff;
    if (!holds_the_same) return name + " changed";
    if (line.pivot != found->pivot) return "the pivot of " + name + " moved";
    return line.color != found->color ? "another colour for " + name : std::string();
}

} // namespace knead

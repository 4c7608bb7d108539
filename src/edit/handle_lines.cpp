#include "edit/handle_lines.h"

#include <algorithm>

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

// All of a handle but its points.
Handle edited(Handle handle, const HandleEdit& edit) {
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
    return line;
}

bool changes(std::span<const Handle> handles, const HandleEdit& edit) {
    const auto found = std::ranges::find(handles, edit.handle, &Handle::name);
    if (found == handles.end()) return false;
    const Handle after = edited(*found, edit);
    return !holds_the_same(*found, after) || after.color != found->color;
}

std::vector<SessionAction> lines_for(std::span<const Handle> handles, const HandleEdit& edit) {
    if (!changes(handles, edit)) return {};
    const auto found = std::ranges::find(handles, edit.handle, &Handle::name);
    const Handle after = edited(*found, edit);
    std::vector<SessionAction> lines{line_of(after)};
    const std::span<const Handle> later(found + 1, handles.end());
    const auto shares = [&](const Handle& one) { return share_points(*found, one); };
    if (!holds_the_same(*found, after) && std::ranges::any_of(later, shares))
        for (const Handle& handle : later) lines.emplace_back(line_of(handle));
    return lines;
}

} // namespace knead

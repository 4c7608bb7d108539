#include "edit/handles.h"

#include "base/error.h"
#include "base/quoted.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace knead {

namespace {

struct Contains {
    Vec3d p;
    bool operator()(const BoxRegion& box) const {
        return (p.array() >= box.lowest.array()).all() && (p.array() <= box.highest.array()).all();
    }
    bool operator()(const SphereRegion& sphere) const { return (p - sphere.center).norm() <= sphere.radius; }
    bool operator()(const HalfspaceRegion& side) const { return (p - side.point).dot(side.normal) >= 0; }
    bool operator()(const WholeRegion& /*whole*/) const { return true; }
};

std::vector<Index> points_of(const std::vector<IndexRange>& ranges, const PointCloud& cloud,
                             const std::string& place) {
    for (const IndexRange& range : ranges)
        if (range.last >= cloud.size())
            throw Error(Trouble::input, place,
                        "\"points\" names point " + std::to_string(range.last) + ", but the cloud has " +
                            std::to_string(cloud.size()) + " points, numbered from 0");
    // Each point once from the start: a short line can name all points many times over.
    std::vector<IndexRange> ascending = ranges;
    std::ranges::sort(ascending, {}, &IndexRange::first);
    std::vector<Index> points;
    std::uint64_t next = 0;
    for (const IndexRange& range : ascending)
        for (next = std::max(next, range.first); next <= range.last; ++next)
            points.push_back(static_cast<Index>(next));
    return points;
}

std::vector<Index> points_in(const Region& region, const PointCloud& cloud,
                             const std::function<Vec3d(std::size_t)>& file_position) {
    std::vector<Index> points;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (is_finite(cloud, i) && std::visit(Contains{file_position(i)}, region))
            points.push_back(static_cast<Index>(i));
    return points;
}

// "between [0.000, 0.000, 0.000] and [1.000, 2.000, 0.500]": to a thousandth of its size
std::string whereabouts(const PointCloud& cloud, const std::function<Vec3d(std::size_t)>& file_position) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (is_finite(cloud, i)) box.extend(file_position(i));
    const double size = std::max(box.diagonal().norm(), 1e-12);
    const int digits = std::max(0, static_cast<int>(std::ceil(3 - std::log10(size))));
    const auto shown = [&](const Vec3d& corner) {
        std::string text = "[";
        for (const double coordinate : corner) {
            char number[400]; // the largest double takes 309 places before the point
            std::snprintf(number, sizeof number, "%.*f", digits, coordinate);
            text.append(text.size() > 1 ? ", " : "").append(number);
        }
        return text + "]";
    };
    return "between " + shown(box.min()) + " and " + shown(box.max());
}

void exchange(const std::optional<HandleChange::Place>& gone, const std::optional<HandleChange::Place>& come,
              std::vector<Handle>& handles) {
    std::optional<HandleChange::Place> coming = come; // what can fail comes first
    handles.reserve(handles.size() + 1);
    if (gone) handles.erase(handles.begin() + gone->at);
    if (coming) handles.insert(handles.begin() + coming->at, std::move(coming->handle));
}

} // namespace

std::optional<std::size_t> number_of(std::span<const Handle> handles, std::string_view name) {
    const auto found = std::ranges::find(handles, name, &Handle::name);
    if (found == handles.end()) return std::nullopt;
    return static_cast<std::size_t>(found - handles.begin());
}

const Handle* handle_named(std::span<const Handle> handles, std::string_view name) {
    const auto number = number_of(handles, name);
    return number ? &handles[*number] : nullptr;
}

bool holds_the_same(const Handle& a, const Handle& b) {
    return a.role == b.role && a.points == b.points && a.free_rotation == b.free_rotation &&
           a.falloff == b.falloff;
}

bool hold_the_same(const std::vector<Handle>& a, const std::vector<Handle>& b) {
    return std::ranges::equal(a, b, holds_the_same);
}

void apply(const HandleChange& change, std::vector<Handle>& handles) {
    exchange(change.gone, change.come, handles);
}

void take_back(const HandleChange& change, std::vector<Handle>& handles) {
    exchange(change.come, change.gone, handles);
}

void append_point(std::vector<IndexRange>& ranges, std::uint64_t point) {
    if (!ranges.empty() && ranges.back().last + 1 == point)
        ranges.back().last = point;
    else
        ranges.push_back({point, point});
}

std::vector<Index> resolve_points(const HandleLine& line, const PointCloud& cloud,
                                  const std::function<Vec3d(std::size_t)>& file_position,
                                  const std::string& place) {
    const std::string named = "the handle " + quoted(line.name);
    std::vector<Index> points;
    if (const auto* ranges = std::get_if<std::vector<IndexRange>>(&line.points)) {
        points = points_of(*ranges, cloud, place);
        if (std::ranges::none_of(points, [&](Index i) { return is_finite(cloud, i); }))
            throw Error(Trouble::input, place,
                        named + " holds no point with finite coordinates that lies anywhere near the others");
    } else {
        points = points_in(std::get<Region>(line.points), cloud, file_position);
        if (points.empty())
            throw Error(Trouble::input, place,
                        named + " holds no points: its \"region\" is empty; the cloud lies " +
                            whereabouts(cloud, file_position));
    }
    return points;
}

} // namespace knead

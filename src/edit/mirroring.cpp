#include "edit/mirroring.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>

namespace knead {

namespace {

// So many points tell where the plane lies, and so many of these are looked for in each place.
constexpr std::size_t enough_points = 20'000, enough_looked_for = 2000;

// How far it may lie off the middle, of the box's width.
constexpr double widest_search = 0.33;

// It is looked for in so many places to each side at most.
constexpr int most_steps = 200;

// The middle is as good where it finds this share of what the best place does.
constexpr double as_good = 0.97;

constexpr int refinements = 4;

// A part's image is laid onto the cloud by so many of its points, in so many rounds.
constexpr std::size_t most_images = 400;
constexpr int rounds_of_shifting = 25;

using Cell = std::array<std::int64_t, 3>;
struct CellHash {
    std::size_t operator()(const Cell& cell) const {
        std::size_t hash = 0;
        for (const std::int64_t c : cell) hash = hash * 0x9e3779b97f4a7c15U + static_cast<std::size_t>(c);
        return hash;
    }
};

// Points of a shape in cells of the size `reach`, with whether they belong to a handle.
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
    void add(const Vec3d& place, bool in_handle) { cells[cell_of(place)].push_back({place, in_handle}); }
    // The nearest within reach; null if there is none.
    const Entry* nearest(const Vec3d& p) const {
        const Cell cell = cell_of(p);
        const Entry* nearest = nullptr;
        double least = reach * reach;
        for (int k = 0; k < 27; ++k) {
            const auto found =
                cells.find({cell[0] + k % 3 - 1, cell[1] + k / 3 % 3 - 1, cell[2] + k / 9 - 1});
            if (found == cells.end()) continue;
            for (const Entry& entry : found->second) {
                const double distance = (entry.place - p).squaredNorm();
                if (distance >= least) continue;
                least = distance;
                nearest = &entry;
            }
        }
        return nearest;
    }
};

Vec3d reflected(Vec3d p, const MirrorPlane& plane) {
    p[plane.axis] = 2 * plane.at - p[plane.axis];
    return p;
}

// A likeness of the cloud in few points, and what it takes to compare it with its mirror image.
struct Likeness {
    PointGrid grid;
    std::vector<Vec3d> looked_for;

    // How many of these have a point where the mirror shows them.
    std::size_t found(const MirrorPlane& plane) const {
        return static_cast<std::size_t>(std::ranges::count_if(looked_for, [&](const Vec3d& p) {
            return grid.cells.contains(grid.cell_of(reflected(p, plane)));
        }));
    }
    // A better place nearby: halfway, on average, between points and what the mirror shows nearest to them.
    double improved(const MirrorPlane& plane) const {
        double sum = 0;
        std::size_t pairs = 0;
        for (const Vec3d& p : looked_for) {
            const Vec3d image = reflected(p, plane);
            const PointGrid::Entry* there = grid.nearest(image);
            if (!there) continue;
            sum += there->place[plane.axis] - image[plane.axis];
            ++pairs;
        }
        return pairs > 0 ? plane.at + 0.5 * sum / static_cast<double>(pairs) : plane.at;
    }
};

Likeness likeness_of(std::span<const float> positions, double spacing) {
    const std::size_t points = positions.size() / 3;
    const std::size_t stride = std::max<std::size_t>(1, points / enough_points);
    // On a surface one of n points lies √n times as far from the next.
    Likeness likeness{{2 * spacing * std::sqrt(static_cast<double>(stride)), {}}, {}};
    const std::size_t apart = std::max(stride, points / enough_looked_for);
    for (std::size_t i = 0; i < points; i += stride) likeness.grid.add(point_at(positions, i), false);
    for (std::size_t i = 0; i < points; i += apart) likeness.looked_for.push_back(point_at(positions, i));
    return likeness;
}

} // namespace

MirrorPlane mirror_plane(std::span<const float> positions, int axis, double spacing) {
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < positions.size() / 3; ++i) box.extend(point_at(positions, i));
    const MirrorPlane middle{axis, box.center()[axis], true};
    if (!(spacing > 0)) return middle;
    const Likeness likeness = likeness_of(positions, spacing);
    const double farthest = widest_search * box.sizes()[axis];
    const double step = std::max(likeness.grid.reach / 2, farthest / most_steps);
    const int steps = static_cast<int>(farthest / step);
    const std::size_t in_middle = likeness.found(middle);
    MirrorPlane best = middle;
    std::size_t most = 0;
    for (int k = -steps; k <= steps; ++k) {
        const MirrorPlane plane{axis, middle.at + k * step, false};
        const std::size_t found = likeness.found(plane);
        const bool is_nearer = std::abs(plane.at - middle.at) < std::abs(best.at - middle.at);
        if (found < most || (found == most && !is_nearer)) continue;
        most = found;
        best = plane;
    }
    if (static_cast<double>(in_middle) >= as_good * static_cast<double>(most)) return middle;
    for (int k = 0; k < refinements; ++k) best.at = likeness.improved(best);
    return best;
}

Reflection reflection(const MirrorPlane& plane, const Vec3d& shift) {
    const Vec3d normal = Vec3d::Unit(plane.axis);
    return {normal, shift + 2 * plane.at * normal};
}

namespace {

// A handle on a shape.
struct Part {
    ShapeInOrder shape;
    std::vector<bool> held; // of the file's points: whether it holds them
    Eigen::AlignedBox3d box;

    Part(const ShapeInOrder& of, std::span<const Index> points) : shape(of), held(of.ordered.size(), false) {
        for (const Index i : points) {
            if (shape.ordered[i] == no_index) continue;
            held[i] = true;
            box.extend(place(i));
        }
    }
    Vec3d place(Index i) const { return point_at(shape.positions, shape.ordered[i]); }
    // Calls visit(i) for every point of the file that is finite.
    template<typename Visit>
    void for_points(Visit&& visit) const {
        for (std::size_t i = 0; i < shape.ordered.size(); ++i)
            if (shape.ordered[i] != no_index) visit(static_cast<Index>(i));
    }
};

std::vector<Index> points_across(const Part& part, const MirrorPlane& plane, const Vec3d& shift,
                                 double reach) {
    Eigen::AlignedBox3d around = part.box;
    around.min().array() -= 2 * reach;
    around.max().array() += 2 * reach;
    PointGrid grid{reach, {}};
    part.for_points([&](Index i) {
        if (around.contains(part.place(i))) grid.add(part.place(i), part.held[i]);
    });
    std::vector<Index> points;
    part.for_points([&](Index i) {
        const Vec3d p = reflected(part.place(i) - shift, plane);
        if (!around.contains(p)) return;
        const PointGrid::Entry* there = grid.nearest(p);
        if (there && there->in_handle) points.push_back(i);
    });
    return points;
}

// What takes the part's mirror image onto the rest of the cloud: every round by how far its points are, on
// average, from those nearest to them.
Vec3d shift_onto_cloud(const Part& part, const MirrorPlane& plane, double least_reach) {
    const double reach = std::max(part.box.sizes().maxCoeff(), least_reach);
    if (!(reach > 0)) return Vec3d::Zero();
    Eigen::AlignedBox3d around(reflected(part.box.min(), plane));
    around.extend(reflected(part.box.max(), plane));
    around.min().array() -= 2 * reach; // as far as it may be shifted, and look from there
    around.max().array() += 2 * reach;
    std::vector<Vec3d> beside;
    part.for_points([&](Index i) {
        if (!part.held[i] && around.contains(part.place(i))) beside.push_back(part.place(i));
    });
    PointGrid grid{reach, {}};
    for (std::size_t k = 0; k < beside.size(); k += beside.size() / enough_points + 1)
        grid.add(beside[k], false);
    std::vector<Vec3d> images;
    std::size_t held = 0;
    const auto apart = static_cast<std::size_t>(std::ranges::count(part.held, true)) / most_images + 1;
    part.for_points([&](Index i) {
        if (part.held[i] && held++ % apart == 0) images.push_back(reflected(part.place(i), plane));
    });
    Vec3d shift = Vec3d::Zero();
    for (int round = 0; round < rounds_of_shifting; ++round) {
        Vec3d sum = Vec3d::Zero();
        std::size_t pairs = 0;
        for (const Vec3d& image : images) {
            const PointGrid::Entry* there = grid.nearest(image + shift);
            if (!there) continue;
            sum += there->place - (image + shift);
            ++pairs;
        }
        if (pairs == 0) break;
        shift += sum / static_cast<double>(pairs);
    }
    return shift;
}

} // namespace

PartAcross part_across(const ShapeInOrder& shape, std::span<const Index> held, const MirrorPlane& plane,
                       double reach) {
    const Part part(shape, held);
    PartAcross across{points_across(part, plane, Vec3d::Zero(), reach)};
    if (2 * across.points.size() >= held.size() || part.box.isEmpty()) return across;
    const Vec3d shift = shift_onto_cloud(part, plane, reach);
    std::vector<Index> shifted = points_across(part, plane, shift, reach);
    if (shifted.size() > across.points.size()) across = {std::move(shifted), shift};
    return across;
}

} // namespace knead

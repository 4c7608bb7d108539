#include "edit/handles.h"

#include "base/error.h"
#include "base/quoted.h"
#include "base/workers.h"
#include "graph/point_order.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <utility>

namespace knead {

namespace {

// Scales that differ from one by less are rounding.
constexpr double unit_scale = 1e-12;

constexpr std::size_t grain = 1 << 14;

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

// Which of two labels a vertex takes that has points of both.
Index stronger(Index a, Index b, Index outside) {
    if (a == no_index) return b;
    if (b == no_index) return a;
    if (a == outside) return b;
    if (b == outside) return a;
    return std::max(a, b);
}

// Labels in numbers that are as narrow as will do: they are looked up in no order, and should fit into a
// cache.
template<typename Label>
void label_by(const std::vector<Handle>& handles, const PointOrder& order, std::size_t file_points,
              Workers& workers, HandleLabels& labels) {
    constexpr Label free = std::numeric_limits<Label>::max();
    const auto is_region = [](const Handle& handle) { return handle.role == HandleRole::region_of_interest; };
    const auto outside = static_cast<Label>(handles.size());
    std::vector<Label> of_file_point(file_points, std::ranges::any_of(handles, is_region) ? outside : free);
    for (const bool region_pass : {true, false})
        for (std::size_t h = 0; h < handles.size(); ++h) {
            if (!handles[h].points || is_region(handles[h]) != region_pass) continue;
            const Label label = region_pass ? free : static_cast<Label>(h);
            const std::vector<Index>& points = *handles[h].points;
            workers.for_each(points.size(), grain, [&](std::size_t i) { of_file_point[points[i]] = label; });
        }

    labels.outside = outside;
    labels.point.resize(order.points(), no_index);
    labels.vertex.resize(order.vertices(), no_index);
    labels.held.resize(blocks_of_rows(order.vertices()), 0);
    labels.changed.resize(labels.held.size(), 0);
    workers.for_each(labels.held.size(), grain / rows_in_block, [&](std::size_t block) {
        const std::size_t begin = block * rows_in_block;
        const std::size_t end = std::min(begin + rows_in_block, order.vertices());
        const auto is_held = [&](Index file_index) { return of_file_point[file_index] != free; };
        const bool held = std::any_of(order.file_index.begin() + order.first_point[begin],
                                      order.file_index.begin() + order.first_point[end], is_held);
        if (!held && !labels.held[block]) return;
        bool changed = false;
        for (Index i = order.first_point[begin]; i < order.first_point[end]; ++i) {
            const Label label = of_file_point[order.file_index[i]];
            const Index before = std::exchange(labels.point[i], label == free ? no_index : Index{label});
            changed |= labels.point[i] != before;
        }
        if (!changed) return;
        labels.held[block] = held ? 1 : 0;
        labels.changed[block] = 1;
        for (std::size_t v = begin; v < end; ++v) {
            labels.vertex[v] = no_index;
            for (Index i = order.first_point[v]; i < order.first_point[v + 1]; ++i)
                labels.vertex[v] = stronger(labels.vertex[v], labels.point[i], outside);
        }
    });
}

} // namespace

bool leaves_rest(const HandleMotion& motion) {
    return motion.linear != Mat3d::Identity() || motion.offset != Vec3d::Zero();
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

HandleMotion motion_of(const HandlePose& pose, const Vec3d& pivot, const Vec3d& origin, const Quatd& before) {
    HandleMotion motion;
    motion.rotation = pose.rotate.normalized();
    if (motion.rotation.dot(before) < 0) motion.rotation.coeffs() = -motion.rotation.coeffs();
    const Mat3d axes = pose.axes.normalized().toRotationMatrix();
    const Mat3d stretch = axes * pose.scale.asDiagonal() * axes.transpose();
    const bool stretched = pose.scale != Vec3d::Ones();
    motion.linear = motion.rotation.toRotationMatrix();
    if (stretched) motion.linear = motion.linear * stretch;
    const Vec3d center = pivot - origin;
    motion.offset = center - motion.linear * center + pose.translate;
    return motion;
}

HandlePose pose_of(const HandleMotion& motion, const Vec3d& pivot, const Vec3d& origin) {
    // linear = R S; what is written must give the very rotation back, whose turns are counted.
    const Mat3d rotation = motion.rotation.toRotationMatrix();
    const Mat3d stretch = rotation.transpose() * motion.linear;
    const Eigen::SelfAdjointEigenSolver<Mat3d> split(0.5 * (stretch + stretch.transpose()));
    if (!(split.eigenvalues().minCoeff() > 0))
        throw Error(Trouble::usage, "", "a handle cannot be mirrored or flattened");
    HandlePose pose;
    pose.rotate = motion.rotation;
    const Vec3d& scale = split.eigenvalues();
    if ((scale - Vec3d::Ones()).cwiseAbs().maxCoeff() > unit_scale) {
        pose.scale = scale;
        Mat3d axes = split.eigenvectors();
        if (axes.determinant() < 0) axes.col(0) = -axes.col(0);
        if (scale.maxCoeff() - scale.minCoeff() > unit_scale) pose.axes = Quatd(axes);
    }
    const Vec3d center = pivot - origin;
    pose.translate = motion.offset - center + motion.linear * center;
    return pose;
}

HandleMotion followed_by(const HandleMotion& motion, const Transform& change) {
    const auto vector = [](const glm::dvec3& v) { return Vec3d(v.x, v.y, v.z); };
    const Quatd turn(Eigen::AngleAxisd(change.angle, vector(change.axis)));
    const Mat3d axes = Quatd(change.axes.w, change.axes.x, change.axes.y, change.axes.z).toRotationMatrix();
    const Mat3d map = turn.toRotationMatrix() * axes * vector(change.scale).asDiagonal() * axes.transpose();
    const Vec3d pivot = vector(change.pivot);

    HandleMotion result;
    result.linear = map * motion.linear;
    result.offset = map * (motion.offset - pivot) + pivot + vector(change.shift);
    if (change.scale == glm::dvec3(1.0)) {
        result.rotation = (turn * motion.rotation).normalized();
        return result;
    }
    // The rotation in the polar decomposition; that of unequal scales is no longer the product of the turns.
    const Eigen::JacobiSVD<Mat3d> svd(result.linear, Eigen::ComputeFullU | Eigen::ComputeFullV);
    result.rotation = Quatd(Mat3d(svd.matrixU() * svd.matrixV().transpose())).normalized();
    const Quatd expected = turn * motion.rotation;
    if (result.rotation.dot(expected) < 0) result.rotation.coeffs() = -result.rotation.coeffs();
    return result;
}

void label_points(const std::vector<Handle>& handles, const PointOrder& order, std::size_t file_points,
                  Workers& workers, HandleLabels& labels) {
    if (handles.size() < std::numeric_limits<std::uint8_t>::max())
        label_by<std::uint8_t>(handles, order, file_points, workers, labels);
    else
        label_by<Index>(handles, order, file_points, workers, labels);
}

} // namespace knead

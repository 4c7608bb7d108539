#include "graph/cell_area.h"

#include "graph/bridges.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

using Eigen::Vector2d;

// What is so many times as far as half of what is up to two links away is not looked at.
constexpr double far_over_median = 3;

// Of a vertex with more links than this, what they lead to is all that is looked at.
constexpr std::size_t enough_around = 24;

// And what is three links away counts where so much of the way's square lies along the plane: the other side
// of a limb does not.
constexpr double along_plane = 1.0 / 3;

double cross(const Vector2d& a, const Vector2d& b) {
    return a.x() * b.y() - a.y() * b.x();
}

double area_of(std::span<const Vector2d> corner) {
    double twice = 0;
    for (std::size_t i = 0; i < corner.size(); ++i)
        twice += cross(corner[i], corner[(i + 1) % corner.size()]);
    return twice / 2;
}

double square_reach(std::span<const Vector2d> corner) {
    double farthest = 0;
    for (const Vector2d& c : corner) farthest = std::max(farthest, c.squaredNorm());
    return farthest;
}

} // namespace

// The ways to what is up to two links away, nearest first, but to what is much farther than half of it: a
// stray that none took for one would tilt the plane.
void CellFinder::gather(Index vertex) {
    const Vec3d own = point_at(positions_, point_[vertex]);
    around_.clear();
    const auto add = [&](Index other) {
        around_.push_back({(point_at(positions_, point_[other]) - own).squaredNorm(), other});
    };
    const std::span<const Index> row = points_.row(vertex);
    for (const Index near : row) {
        if (hangs(hanging_, near)) continue;
        add(near);
        if (row.size() > enough_around) continue;
        for (const Index far : points_.row(near))
            if (far != vertex && !hangs(hanging_, far)) add(far);
    }
    std::ranges::sort(around_);
    around_.erase(std::unique(around_.begin(), around_.end()), around_.end());
    way_.clear();
    if (around_.empty()) return;
    const double farthest = far_over_median * far_over_median * around_[around_.size() / 2].first;
    for (const auto& [square, other] : around_)
        if (square <= farthest) way_.emplace_back(point_at(positions_, point_[other]) - own);
}

void CellFinder::flatten(Cell& cell) {
    const double count = static_cast<double>(way_.size()) + 1; // and the vertex
    Vec3d mean = Vec3d::Zero();
    Mat3d spread = Mat3d::Zero();
    for (const Vec3d& way : way_) {
        mean += way / count;
        spread += way * way.transpose() / count;
    }
    spread -= mean * mean.transpose();
    Eigen::SelfAdjointEigenSolver<Mat3d> axes;
    axes.computeDirect(spread);
    const Vec3d& along = axes.eigenvalues();
    cell.thickness = along[2] > 0 ? std::max(0.0, along[0]) / along[2] : 1;
    cell.width = along[2] > 0 ? std::max(0.0, along[1]) / along[2] : 0;
    cell.square_way = axes.eigenvalues().sum() + mean.squaredNorm(); // the trace about the vertex
    axes_ << axes.eigenvectors().col(2).transpose(), axes.eigenvectors().col(1).transpose();
    for (const Vec3d& way : way_) in_plane_.emplace_back(axes_ * way);
}

// By what is three links away, which has a say in the cell of a point that lies at the edge of a gap.
void CellFinder::cut_by_farther(Index vertex) {
    const Vec3d own = point_at(positions_, point_[vertex]);
    for (const auto& [square, near] : around_)
        for (const Index far : points_.row(near)) {
            if (far == vertex || hangs(hanging_, far)) continue;
            const Vec3d way = point_at(positions_, point_[far]) - own;
            const Vector2d flat = axes_ * way;
            if (flat.squaredNorm() > along_plane * way.squaredNorm()) cut(flat);
        }
}

void CellFinder::cut(const Vector2d& other) {
    const double square = other.squaredNorm();
    if (!(square > 0) || square > 4 * square_reach_) return; // or its bisector passes the cell by
    const auto beyond = [&](const Vector2d& c) { return c.dot(other) - square / 2; };
    kept_.clear();
    for (std::size_t i = 0; i < corner_.size(); ++i) {
        const Vector2d &here = corner_[i], &next = corner_[(i + 1) % corner_.size()];
        const double from = beyond(here), to = beyond(next);
        if (from <= 0) kept_.push_back(here);
        if ((from < 0 && to > 0) || (from > 0 && to < 0))
            kept_.emplace_back(here + from / (from - to) * (next - here));
    }
    std::swap(corner_, kept_);
    square_reach_ = square_reach(corner_);
}

Cell CellFinder::find(Index vertex) {
    Cell cell;
    gather(vertex);
    corner_.clear();
    in_plane_.clear();
    if (way_.size() < 3) return cell;
    flatten(cell);
    const double half = way_.back().norm();
    corner_ = {{-half, -half}, {half, -half}, {half, half}, {-half, half}};
    square_reach_ = square_reach(corner_);
    for (const Vector2d& other : in_plane_) cut(other);
    if (4 * square_reach_ > half * half) cut_by_farther(vertex); // than all around it
    const bool is_bounded = std::ranges::all_of(
        corner_, [half](const Vector2d& c) { return c.lpNorm<Eigen::Infinity>() < (1 - 1e-9) * half; });
    cell.reach = is_bounded ? std::sqrt(square_reach_) : std::numeric_limits<double>::infinity();
    cell.area = area_of(corner_);
    return cell;
}

double CellFinder::mirrored() {
    for (const Vector2d& other : in_plane_) cut(-other);
    return area_of(corner_);
}

} // namespace knead

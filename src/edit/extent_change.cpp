#include "edit/extent_change.h"

#include "deform/stretch.h"

#include <Eigen/Eigenvalues>

#include <cmath>
#include <vector>

namespace knead {

namespace {

constexpr double closed_within = 0.05;

// What one vertex stands for.
struct Piece {
    double area = 0, volume = 0;         // when opened, up to a factor that is the same for all
    double area_now = 0, volume_now = 0; // in the same unit
    double thickness = 0;                // 0 on a surface, 1 in a solid
    Vec3d facing = Vec3d::Zero();        // the normal, as long as the area
    Vec3d facing_now = Vec3d::Zero();
};

struct Shapes {
    const Numbering& point;
    const Graph& graph;
    std::span<const float> opened, normals, now;
};

Piece piece_of(const Shapes& shapes, Index vertex) {
    const Index here = shapes.point[vertex];
    Mat3d spread = Mat3d::Zero();
    Mat3d moved = Mat3d::Zero();
    Piece piece;
    const auto links = static_cast<double>(shapes.graph.row(vertex).size());
    for (const Index other : shapes.graph.row(vertex)) {
        const Index there = shapes.point[other];
        const Vec3d edge = point_at(shapes.opened, there) - point_at(shapes.opened, here);
        spread += edge * edge.transpose();
        moved += (point_at(shapes.now, there) - point_at(shapes.now, here)) * edge.transpose();
        piece.area += edge.squaredNorm() / links;
        piece.volume += edge.squaredNorm() * edge.norm() / links;
    }
    Eigen::SelfAdjointEigenSolver<Mat3d> axes;
    axes.computeDirect(spread);
    const Vec3d& spreads = axes.eigenvalues();
    if (!(spreads[1] > 1e-6 * spreads[2])) return {}; // links on a line span nothing
    piece.thickness = surroundings_of(spread).thickness;
    const Vec3d along = moved * axes.eigenvectors().col(2) / spreads[2];
    const Vec3d across = moved * axes.eigenvectors().col(1) / spreads[1];
    const Vec3d turned = along.cross(across);
    piece.area_now = piece.area * turned.norm();
    const Vec3d up = axes.eigenvectors().col(2).cross(axes.eigenvectors().col(1));
    if (piece.thickness == 0) {
        piece.volume = 0;
    } else {
        piece.volume_now = piece.volume * std::abs(turned.dot(moved * up / spreads[0]));
    }
    if (!shapes.normals.empty()) {
        const double side = up.dot(point_at(shapes.normals, here)) < 0 ? -1 : 1;
        piece.facing = side * piece.area * up;
        piece.facing_now = side * piece.area * turned;
    }
    return piece;
}

// Three times the volume that the pieces enclose; nothing if they do not.
std::optional<double> enclosed(const Shapes& shapes, std::span<const Piece> pieces,
                               std::span<const float> positions, Vec3d Piece::*facing) {
    Vec3d middle = Vec3d::Zero(), sum = Vec3d::Zero();
    double area = 0;
    for (std::size_t v = 0; v < pieces.size(); ++v) {
        const double size = (pieces[v].*facing).norm();
        middle += size * point_at(positions, shapes.point[v]);
        sum += pieces[v].*facing;
        area += size;
    }
    if (!(area > 0) || sum.norm() > closed_within * area) return std::nullopt;
    middle /= area;
    double volume = 0;
    for (std::size_t v = 0; v < pieces.size(); ++v)
        volume += (pieces[v].*facing).dot(point_at(positions, shapes.point[v]) - middle);
    return std::abs(volume);
}

} // namespace

ExtentChange extent_change(const Numbering& point, const Graph& graph, std::span<const float> opened,
                           std::span<const float> normals, std::span<const float> now, Workers& workers) {
    const Shapes shapes{point, graph, opened, normals, now};
    std::vector<Piece> pieces(graph.size());
    workers.for_each(pieces.size(), 1024,
                     [&](std::size_t v) { pieces[v] = piece_of(shapes, static_cast<Index>(v)); });
    Piece sum;
    for (const Piece& piece : pieces) {
        sum.area += piece.area;
        sum.area_now += piece.area_now;
        sum.volume += piece.volume;
        sum.volume_now += piece.volume_now;
        sum.thickness += piece.thickness / static_cast<double>(pieces.size());
    }
    ExtentChange change;
    if (sum.thickness > 0.5) {
        change.volume = sum.volume_now / sum.volume - 1;
    } else if (sum.area > 0) {
        change.area = sum.area_now / sum.area - 1;
        const auto before = enclosed(shapes, pieces, opened, &Piece::facing);
        const auto after = enclosed(shapes, pieces, now, &Piece::facing_now);
        if (before && after && *before > 0) change.volume = *after / *before - 1;
    }
    return change;
}

} // namespace knead

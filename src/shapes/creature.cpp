#include "shapes/creature.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

namespace knead {

namespace {

double distance_to(const RoundCone& cone, const Vec3d& place) {
    const Vec3d axis = cone.to - cone.from;
    const double length_squared = axis.squaredNorm();
    const double taper = cone.from_radius - cone.to_radius;
    const double slope = length_squared - taper * taper; // not positive: one ball holds the other
    const Vec3d offset = place - cone.from;
    if (slope <= 0)
        return std::min(offset.norm() - cone.from_radius, (place - cone.to).norm() - cone.to_radius);
    const double y = offset.dot(axis);
    const double z = y - length_squared;
    const double x2 = (offset * length_squared - axis * y).squaredNorm();
    const double y2 = y * y * length_squared;
    const double z2 = z * z * length_squared;
    const double k = std::copysign(1.0, taper) * taper * taper * x2;
    if (std::copysign(1.0, z) * slope * z2 > k) return std::sqrt(x2 + z2) / length_squared - cone.to_radius;
    if (std::copysign(1.0, y) * slope * y2 < k) return std::sqrt(x2 + y2) / length_squared - cone.from_radius;
    return (std::sqrt(x2 * slope / length_squared) + y * taper) / length_squared - cone.from_radius;
}

double squared_distance_to_edge(const Vec3d& from, const Vec3d& to, const Vec3d& place) {
    const Vec3d edge = to - from;
    const double along = std::clamp((place - from).dot(edge) / edge.squaredNorm(), 0.0, 1.0);
    return (place - from - along * edge).squaredNorm();
}

double distance_to(const RoundTriangle& triangle, const Vec3d& place) {
    const auto& corner = triangle.corners;
    const Vec3d normal = (corner[1] - corner[0]).cross(corner[2] - corner[0]);
    bool above = true;
    double squared = std::numeric_limits<double>::infinity();
    for (std::size_t side = 0; side < 3; ++side) {
        const Vec3d& from = corner[side];
        const Vec3d& to = corner[(side + 1) % 3];
        above = above && normal.cross(to - from).dot(place - from) >= 0;
        squared = std::min(squared, squared_distance_to_edge(from, to, place));
    }
    if (!above) return std::sqrt(squared) - triangle.radius;
    return std::abs(normal.dot(place - corner[0])) / normal.norm() - triangle.radius;
}

double distance_to(const CreaturePiece& piece, const Vec3d& place) {
    return piece.is_cone ? distance_to(piece.cone, place) : distance_to(piece.triangle, place);
}

Ball ball_around(const CreaturePiece& piece) {
    if (piece.is_cone) {
        const RoundCone& cone = piece.cone;
        return {0.5 * (cone.from + cone.to),
                0.5 * (cone.to - cone.from).norm() + std::max(cone.from_radius, cone.to_radius)};
    }
    const auto& corner = piece.triangle.corners;
    const Vec3d middle = (corner[0] + corner[1] + corner[2]) / 3;
    double reach = 0;
    for (const Vec3d& each : corner) reach = std::max(reach, (each - middle).norm());
    return {middle, reach + piece.triangle.radius};
}

double smooth_minimum(double a, double b, double width) {
    if (width <= 0) return std::min(a, b);
    const double overlap = std::max(width - std::abs(a - b), 0.0);
    return std::min(a, b) - 0.25 * overlap * overlap / width;
}

// --- Its build
// -------------------------------------------------------------------------------------------------

struct Builder {
    Creature creature;

    void add_cone(BodyPart part, const RoundCone& cone, double blend, double along_from = 0,
                  double along_to = 0) {
        CreaturePiece piece;
        piece.part = part;
        piece.cone = cone;
        piece.blend = blend;
        piece.along_from = along_from;
        piece.along_to = along_to;
        creature.pieces.push_back(piece);
    }

    void add_triangle(BodyPart part, const RoundTriangle& triangle, double blend) {
        CreaturePiece piece;
        piece.part = part;
        piece.is_cone = false;
        piece.triangle = triangle;
        piece.blend = blend;
        creature.pieces.push_back(piece);
    }

    // Closes the group of the pieces since the last one.
    void end_group() {
        PieceGroup group;
        group.first = creature.groups.empty() ? 0 : creature.groups.back().end;
        group.end = creature.pieces.size();
        Vec3d lowest = Vec3d::Constant(std::numeric_limits<double>::infinity());
        Vec3d highest = -lowest;
        for (std::size_t i = group.first; i < group.end; ++i) {
            const Ball ball = ball_around(creature.pieces[i]);
            creature.around.push_back(ball);
            lowest = lowest.cwiseMin(ball.middle - Vec3d::Constant(ball.radius));
            highest = highest.cwiseMax(ball.middle + Vec3d::Constant(ball.radius));
            group.widest_blend = std::max(group.widest_blend, creature.pieces[i].blend);
        }
        group.around.middle = 0.5 * (lowest + highest);
        for (std::size_t i = group.first; i < group.end; ++i) {
            const Ball& ball = creature.around[i];
            group.around.radius =
                std::max(group.around.radius, (ball.middle - group.around.middle).norm() + ball.radius);
        }
        creature.groups.push_back(group);
    }
};

void build_head(Builder& builder) {
    builder.add_cone(BodyPart::head, {{0.02, -0.08, 1.36}, {0.02, 0.08, 1.36}, 0.27, 0.27}, 0.06);
    for (const double side : {-1.0, 1.0})
        builder.add_cone(BodyPart::head, {{0.06, side * 0.18, 1.29}, {0.06, side * 0.2, 1.29}, 0.17, 0.165},
                         0.1);
    for (const double side : {-1.0, 1.0}) {
        const RoundTriangle ear{
            {Vec3d(0.02, side * 0.09, 1.58), Vec3d(0.0, side * 0.3, 1.46), Vec3d(0.01, side * 0.27, 1.77)},
            0.03};
        builder.add_triangle(BodyPart::ear, ear, 0.05);
    }
    for (const double side : {-1.0, 1.0})
        builder.add_cone(BodyPart::muzzle,
                         {{0.25, side * 0.05, 1.25}, {0.25, side * 0.06, 1.25}, 0.085, 0.08}, 0.04);
    builder.add_cone(BodyPart::muzzle, {{0.24, 0, 1.2}, {0.23, 0, 1.19}, 0.07, 0.07}, 0.03);
    builder.add_cone(BodyPart::nose, {{0.335, -0.018, 1.3}, {0.335, 0.018, 1.3}, 0.028, 0.028}, 0.015);
    for (const double side : {-1.0, 1.0})
        builder.add_cone(BodyPart::eye, {{0.19, side * 0.13, 1.415}, {0.19, side * 0.13, 1.415}, 0.11, 0.11},
                         0.01);
    builder.end_group();
}

void build_limbs(Builder& builder, double side) {
    const auto at = [side](double x, double y, double z) { return Vec3d(x, side * y, z); };
    builder.add_cone(BodyPart::arm, {at(0, 0.14, 0.93), at(0.02, 0.5, 0.93), 0.092, 0.074}, 0.07, 0, 0.5);
    builder.add_cone(BodyPart::arm, {at(0.02, 0.5, 0.93), at(0.06, 0.82, 1.0), 0.074, 0.078}, 0.04, 0.5, 0.9);
    builder.add_cone(BodyPart::arm, {at(0.06, 0.86, 1.0), at(0.07, 0.9, 1.015), 0.1, 0.095}, 0.05, 0.95, 1);
    builder.end_group();
    builder.add_cone(BodyPart::leg, {at(0, 0.15, 0.5), at(0.01, 0.18, 0.14), 0.125, 0.1}, 0.06, 0, 0.75);
    builder.add_cone(BodyPart::leg, {at(0.0, 0.185, 0.085), at(0.14, 0.2, 0.075), 0.085, 0.075}, 0.05, 0.85,
                     1);
    builder.end_group();
}

// An S behind the back: a Bézier curve in the plane y = 0, as a chain of cones.
void build_tail(Builder& builder) {
    const std::array<Vec3d, 4> control{Vec3d(-0.16, 0, 0.52), Vec3d(-0.9, 0, 0.2), Vec3d(-0.75, 0, 0.85),
                                       Vec3d(-0.72, 0, 1.22)};
    const auto at = [&](double t) -> Vec3d {
        const double s = 1 - t;
        return s * s * s * control[0] + 3 * s * s * t * control[1] + 3 * s * t * t * control[2] +
               t * t * t * control[3];
    };
    const auto radius = [](double t) { return 0.075 - 0.012 * t; };
    constexpr int pieces = 12;
    for (int i = 0; i < pieces; ++i) {
        const double from = static_cast<double>(i) / pieces;
        const double to = static_cast<double>(i + 1) / pieces;
        builder.add_cone(BodyPart::tail, {at(from), at(to), radius(from), radius(to)}, i == 0 ? 0.07 : 0.01,
                         from, to);
        if (i == 5 || i == pieces - 1) builder.end_group();
    }
}

} // namespace

Creature make_creature() {
    Builder builder;
    builder.add_cone(BodyPart::body, {{0, 0, 0.66}, {0, 0, 0.93}, 0.275, 0.205}, 0);
    builder.add_cone(BodyPart::body, {{0.06, 0, 0.62}, {0.05, 0, 0.7}, 0.25, 0.24}, 0.05);
    builder.end_group();
    build_head(builder);
    build_limbs(builder, -1);
    build_limbs(builder, 1);
    build_tail(builder);
    return builder.creature;
}

double creature_distance(const Creature& creature, const Vec3d& place) {
    // The farther groups blend with nothing: whether a group counts is seen from its ball alone.
    double distance = std::numeric_limits<double>::infinity();
    const auto counts = [&](const Ball& ball, double blend) {
        const double limit = distance + blend + ball.radius;
        return limit > 0 && (place - ball.middle).squaredNorm() < limit * limit;
    };
    for (const PieceGroup& group : creature.groups) {
        if (!counts(group.around, group.widest_blend)) continue;
        for (std::size_t i = group.first; i < group.end; ++i) {
            const CreaturePiece& piece = creature.pieces[i];
            if (!counts(creature.around[i], piece.blend)) continue;
            distance = smooth_minimum(distance, distance_to(piece, place), piece.blend);
        }
    }
    return distance;
}

NearestPiece nearest_piece(const Creature& creature, const Vec3d& place) {
    NearestPiece nearest;
    double least = std::numeric_limits<double>::infinity();
    for (const CreaturePiece& piece : creature.pieces) {
        const double distance = distance_to(piece, place);
        if (distance >= least) continue;
        least = distance;
        nearest.piece = &piece;
    }
    const CreaturePiece& found = *nearest.piece;
    const Vec3d axis = found.cone.to - found.cone.from;
    const double length_squared = axis.squaredNorm();
    const double share =
        length_squared > 0 ? std::clamp((place - found.cone.from).dot(axis) / length_squared, 0.0, 1.0) : 0;
    nearest.along = found.along_from + share * (found.along_to - found.along_from);
    return nearest;
}

ScannedBody creature_body() {
    const auto creature = std::make_shared<const Creature>(make_creature());
    ScannedBody body;
    body.distance = [creature](const Vec3d& place) { return creature_distance(*creature, place); };
    body.colour = [creature](const Vec3d& place, const Vec3d& normal) {
        return creature_colour(*creature, place, normal);
    };
    body.lowest = {-0.84, -1.0, 0.0};
    body.highest = {0.37, 1.0, 1.8};
    return body;
}

std::vector<Viewpoint> creature_viewpoints() {
    return {
        {{3.0, 0.3, 1.35}, 1.2},  // in front
        {{2.3, 2.4, 1.6}, 1.1},   // from its left, in front
        {{2.3, -2.4, 1.2}, 1.1},  // from its right, in front
        {{-0.5, 3.6, 1.1}, 1.0},  // from its left
        {{-0.5, -3.6, 1.4}, 1.0}, // from its right
        {{-3.2, 1.9, 1.5}, 1.0},  // from behind
        {{-3.2, -1.9, 1.9}, 1.0}, // from behind
        {{1.0, 0.3, 4.6}, 1.0},   // from above
    };
}

} // namespace knead

#include "view/gizmo.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace knead {

namespace {

// In parts of the gizmo's size.
constexpr double ring_radius = 0.7;
constexpr double shaft_from = 0.15;
constexpr double head_from = 0.84;
constexpr double head_width = 0.055;
constexpr double plane_from = 0.22;
constexpr double plane_to = 0.4;
constexpr double box_at = 1.14;
constexpr double box_half = 0.06;
constexpr double screen_ring_radius = 1.3;
constexpr double center_radius = 0.1;

// An axis within 14° of the view, and a plane within 9°, are left out. A ring seen from its side is a line
// that can still be dragged across.
constexpr double arrow_end_on = 0.97;
constexpr double plane_edge_on = 0.15;
constexpr double ring_faces = 0.98;  // no half of it faces away
constexpr double ring_edge_on = 0.1; // it is a line, which lies on arrows

constexpr int ring_corners = 96;
constexpr int disc_corners = 24;

// Collects shapes about one centre.
struct Drawing {
    const Gizmo& gizmo;
    const Camera& camera;
    Viewport viewport;
    glm::dvec2 center{0.0}; // pixel
    double depth = 0;
    double unit = 0; // the gizmo's size in the world
    glm::dvec3 to_eye{0.0};
    std::vector<GizmoShape> shapes{};

    glm::dvec3 axis(int i) const {
        glm::dvec3 v(0.0);
        v[i] = 1;
        return gizmo.axes * v;
    }
    Constraint constraint(Constraint::Kind kind, int i) const { return {kind, i, gizmo.local}; }

    // Adds a shape through points about the centre, in parts of the size; none if one is behind the eye.
    void add(const GizmoPart& part, std::span<const glm::dvec3> points, bool filled, bool closed, int color,
             bool behind = false) {
        GizmoShape shape{part, {}, filled, closed, color, 0, behind};
        for (const glm::dvec3& point : points) {
            const auto seen = project(camera, viewport, gizmo.center + unit * point);
            if (!seen) return;
            shape.outline.push_back(seen->pixel);
            shape.depth += seen->depth / static_cast<double>(points.size());
        }
        shapes.push_back(std::move(shape));
    }
};

void add_arrow(Drawing& drawing, int i) {
    const glm::dvec3 along = drawing.axis(i);
    const GizmoPart part{TransformKind::translate, drawing.constraint(Constraint::Kind::axis, i)};
    drawing.add(part, std::array{shaft_from * along, head_from * along}, false, false, i);
    // A flat head that turns its face to the eye.
    const glm::dvec3 aside = head_width * glm::normalize(glm::cross(along, drawing.to_eye));
    drawing.add(part, std::array{along, head_from * along + aside, head_from * along - aside}, true, true, i);
}

void add_box(Drawing& drawing, int i) {
    const GizmoPart part{TransformKind::scale, drawing.constraint(Constraint::Kind::axis, i)};
    const double at = drawing.gizmo.translate ? box_at : 1.0;
    const glm::dvec3 middle = at * drawing.axis(i);
    if (!drawing.gizmo.translate)
        drawing.add(part, std::array{shaft_from * drawing.axis(i), (at - box_half) * drawing.axis(i)}, false,
                    false, i);
    const glm::dvec3 right = box_half * (drawing.camera.orientation * glm::dvec3(1, 0, 0));
    const glm::dvec3 up = box_half * (drawing.camera.orientation * glm::dvec3(0, 1, 0));
    drawing.add(
        part, std::array{middle - right - up, middle + right - up, middle + right + up, middle - right + up},
        true, true, i);
}

void add_plane(Drawing& drawing, int normal) {
    const GizmoPart part{TransformKind::translate, drawing.constraint(Constraint::Kind::plane, normal)};
    const glm::dvec3 u = drawing.axis((normal + 1) % 3);
    const glm::dvec3 v = drawing.axis((normal + 2) % 3);
    drawing.add(part,
                std::array{plane_from * (u + v), plane_to * u + plane_from * v, plane_to * (u + v),
                           plane_from * u + plane_to * v},
                true, true, normal);
}

std::vector<glm::dvec3> arc(const glm::dvec3& u, const glm::dvec3& v, double from, double to, int corners) {
    std::vector<glm::dvec3> points;
    for (int i = 0; i <= corners; ++i) {
        const double angle = from + (to - from) * i / corners;
        points.push_back(std::cos(angle) * u + std::sin(angle) * v);
    }
    return points;
}

void add_ring(Drawing& drawing, int i) {
    constexpr double pi = std::numbers::pi;
    const GizmoPart part{TransformKind::rotate, drawing.constraint(Constraint::Kind::axis, i)};
    const glm::dvec3 normal = drawing.axis(i);
    // u is where the ring is nearest to the eye, so that the halves part where it turns away.
    const glm::dvec3 flat = drawing.to_eye - glm::dot(drawing.to_eye, normal) * normal;
    const double facing = std::abs(glm::dot(drawing.to_eye, normal));
    const bool faces = facing > ring_faces, is_line = facing < ring_edge_on;
    const glm::dvec3 start = faces ? drawing.axis((i + 1) % 3) : glm::normalize(flat);
    const glm::dvec3 u = ring_radius * start;
    const glm::dvec3 v = ring_radius * glm::cross(normal, start);
    if (faces) {
        std::vector<glm::dvec3> whole = arc(u, v, 0, 2 * pi, ring_corners);
        whole.pop_back();
        drawing.add(part, whole, false, true, i);
        return;
    }
    drawing.add(part, arc(u, v, 0.5 * pi, 1.5 * pi, ring_corners / 2), false, false, i, true);
    drawing.add(part, arc(u, v, -0.5 * pi, 0.5 * pi, ring_corners / 2), false, false, i, is_line);
}

// A circle about the centre that is round on the screen.
void add_circle(Drawing& drawing, const GizmoPart& part, double radius, bool filled, int corners,
                double depth) {
    GizmoShape shape{part, {}, filled, true, 3, depth, false};
    for (int i = 0; i < corners; ++i) {
        const double angle = 2 * std::numbers::pi * i / corners;
        shape.outline.push_back(drawing.center +
                                radius * drawing.gizmo.size * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    drawing.shapes.push_back(std::move(shape));
}

void add_axis_parts(Drawing& drawing, int i) {
    const double facing = std::abs(glm::dot(drawing.to_eye, drawing.axis(i)));
    if (drawing.gizmo.rotate) add_ring(drawing, i);
    if (drawing.gizmo.translate && facing > plane_edge_on) add_plane(drawing, i);
    if (facing > arrow_end_on) return;
    if (drawing.gizmo.translate) add_arrow(drawing, i);
    if (drawing.gizmo.scale) add_box(drawing, i);
}

double cross_of(glm::dvec2 a, glm::dvec2 b) {
    return a.x * b.y - a.y * b.x;
}

double distance_to_segment(glm::dvec2 p, glm::dvec2 a, glm::dvec2 b) {
    const glm::dvec2 way = b - a;
    const double squared = glm::dot(way, way);
    const double along = squared > 0 ? std::clamp(glm::dot(p - a, way) / squared, 0.0, 1.0) : 0.0;
    return glm::length(p - a - along * way);
}

bool inside_convex(std::span<const glm::dvec2> outline, glm::dvec2 p) {
    bool left = false;
    bool right = false;
    for (std::size_t i = 0; i < outline.size(); ++i) {
        const glm::dvec2 a = outline[i];
        const double side = cross_of(outline[(i + 1) % outline.size()] - a, p - a);
        left = left || side > 0;
        right = right || side < 0;
    }
    return !(left && right);
}

double distance_to(const GizmoShape& shape, glm::dvec2 p) {
    if (shape.filled && inside_convex(shape.outline, p)) return 0;
    double nearest = std::numeric_limits<double>::infinity();
    const std::size_t count = shape.outline.size();
    for (std::size_t i = shape.closed ? 0 : 1; i < count; ++i)
        nearest = std::min(nearest,
                           distance_to_segment(p, shape.outline[(i + count - 1) % count], shape.outline[i]));
    return nearest;
}

// Which parts are taken first where several are within reach: the disc in the middle and whatever is small,
// then what is long and thin.
int rank_of(const GizmoPart& part) {
    if (part.kind != TransformKind::rotate) return 0;
    return part.constraint.kind == Constraint::Kind::free ? 2 : 1;
}

} // namespace

bool has_effect(const Gizmo& gizmo, TransformKind kind) {
    switch (kind) {
    case TransformKind::translate:
        return gizmo.translate;
    case TransformKind::rotate:
        return gizmo.rotate;
    default:
        return gizmo.scale;
    }
}

std::vector<GizmoShape> gizmo_shapes(const Gizmo& gizmo, const Camera& camera, Viewport viewport) {
    const auto seen = project(camera, viewport, gizmo.center);
    if (!seen) return {};
    Drawing drawing{gizmo, camera, viewport};
    drawing.center = seen->pixel;
    drawing.depth = seen->depth;
    drawing.unit = gizmo.size * pixel_size_at(camera, viewport, gizmo.center);
    drawing.to_eye = -ray_through(camera, viewport, seen->pixel).direction;
    for (int i = 0; i < 3; ++i) add_axis_parts(drawing, i);
    const double size = drawing.unit;
    if (gizmo.rotate)
        add_circle(drawing, {TransformKind::rotate, {}}, screen_ring_radius, false, ring_corners,
                   seen->depth + size);
    if (gizmo.translate || gizmo.scale) {
        const TransformKind kind = gizmo.translate ? TransformKind::translate : TransformKind::scale;
        add_circle(drawing, {kind, {}}, center_radius, true, disc_corners, seen->depth - size);
    }
    std::ranges::stable_sort(drawing.shapes, std::ranges::greater(), [](const GizmoShape& shape) {
        return std::pair(shape.part.kind == TransformKind::rotate, shape.depth);
    });
    return std::move(drawing.shapes);
}

std::optional<GizmoPart> gizmo_part_under(const Gizmo& gizmo, const Camera& camera, Viewport viewport,
                                          glm::dvec2 cursor, GizmoReach reach) {
    std::optional<GizmoPart> best;
    int best_rank = 0;
    double best_depth = 0;
    for (const GizmoShape& shape : gizmo_shapes(gizmo, camera, viewport)) {
        const bool is_ring = shape.part.kind == TransformKind::rotate;
        if (distance_to(shape, cursor) > (is_ring ? reach.rings : reach.others)) continue;
        const int rank = rank_of(shape.part);
        if (best && (rank > best_rank || (rank == best_rank && shape.depth >= best_depth))) continue;
        best = shape.part;
        best_rank = rank;
        best_depth = shape.depth;
    }
    return best;
}

} // namespace knead

#include "view/transform_drag.h"

#include "view/projector.h"
#include "view/typed_amount.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace knead {

namespace {

constexpr double pi = std::numbers::pi;
constexpr double snap_angle = pi / 36; // 5°
constexpr double snap_factor = 0.1;
constexpr double grid_pixels = 20;       // a step of the grid is about as long on the screen
constexpr double pixels_per_radian = 90; // across an axis that lies in the screen
constexpr double facing_enough = 0.15;   // cosine from which on an axis is turned like a dial
constexpr double dead_pixels = 2;        // around the pivot, where the cursor has no angle
constexpr double farthest_shift = 20;    // in ways of the hand; the horizon is farther
constexpr double end_on = 0.1;           // sine of the angle to the view below which an axis has no direction
constexpr double edge_on = 0.05;         // cosine … below which a plane has no area

glm::dvec3 unit(int axis) {
    glm::dvec3 v(0.0);
    v[axis] = 1;
    return v;
}

// The axis of the constraint in the world; of a free one that towards the eye.
glm::dvec3 axis_of(const TransformDrag& drag) {
    if (drag.constraint.kind == Constraint::Kind::free) return drag.screen_axis;
    const glm::dvec3 axis = unit(drag.constraint.axis);
    return drag.constraint.local ? drag.local_axes * axis : axis;
}

// The frame in which lengths are snapped and told.
glm::dquat frame_of(const TransformDrag& drag) {
    return drag.constraint.local ? drag.local_axes : glm::dquat(1, 0, 0, 0);
}

// What the constraint leaves of a shift.
glm::dvec3 constrained(const TransformDrag& drag, const glm::dvec3& shift) {
    if (drag.constraint.kind == Constraint::Kind::free) return shift;
    const glm::dvec3 axis = axis_of(drag);
    const glm::dvec3 along = glm::dot(shift, axis) * axis;
    return drag.constraint.kind == Constraint::Kind::axis ? along : shift - along;
}

// The pivot as the drag's camera sees it, and how far the cursor drags it there.
struct Grip {
    Projector projector;
    glm::dvec2 pivot; // pixel
    double depth;     // of the pivot
    double pixel;     // length of one at the pivot
};

Grip grip_of(const TransformDrag& drag) {
    const Projector projector(drag.camera, drag.viewport);
    Projector::Seen seen = projector(drag.pivot);
    // A pivot behind the eye has no pixel; the middle of the screen at the camera's own depth stands in.
    if (!projector.in_front(seen.depth))
        seen = {projector.half_width, projector.half_height, drag.camera.distance};
    return {projector, {seen.x, seen.y}, seen.depth, projector.pixel_size(seen.depth)};
}

glm::dvec3 in_screen_plane(const Grip& grip, glm::dvec2 way) {
    return grip.pixel * (way.x * grip.projector.right - way.y * grip.projector.up);
}

// How far along the axis the pivot goes to be nearest to what `way` pixels from it is pointed at.
double shift_along(const TransformDrag& drag, const Grip& grip, const glm::dvec3& axis, glm::dvec2 way) {
    const Ray at_pivot = ray_through(drag.camera, drag.viewport, grip.pivot);
    const double end = glm::dot(at_pivot.direction, axis);
    // Seen end-on the axis has no direction on the screen: up is away.
    if (1 - end * end < end_on * end_on) return -way.y * grip.pixel * (end > 0 ? 1 : -1);
    const Ray ray = ray_through(drag.camera, drag.viewport, grip.pivot + way);
    const glm::dvec3 from_eye = drag.pivot - ray.origin;
    const double b = glm::dot(ray.direction, axis);
    const double sine = 1 - b * b;
    const double limit = farthest_shift * glm::length(way) * grip.pixel;
    const double along = sine > 1e-12
                             ? (b * glm::dot(ray.direction, from_eye) - glm::dot(axis, from_eye)) / sine
                             : (end > 0 ? limit : -limit);
    // Beyond the point where the axis vanishes, the nearest point lies behind the eye.
    const bool behind = !drag.camera.orthographic && glm::dot(ray.direction, from_eye) + along * b <= 0;
    if (behind) return end > 0 ? limit : -limit;
    return std::clamp(along, -limit, limit);
}

glm::dvec3 shift_in_plane(const TransformDrag& drag, const Grip& grip, const glm::dvec3& normal,
                          glm::dvec2 way) {
    const glm::dvec3 free = in_screen_plane(grip, way);
    const Ray at_pivot = ray_through(drag.camera, drag.viewport, grip.pivot);
    if (std::abs(glm::dot(at_pivot.direction, normal)) < edge_on)
        return free - glm::dot(free, normal) * normal;
    const Ray ray = ray_through(drag.camera, drag.viewport, grip.pivot + way);
    const double distance = glm::dot(drag.pivot - ray.origin, normal) / glm::dot(ray.direction, normal);
    // Above the horizon the ray meets the plane nowhere, or behind the eye; below it very far away.
    const bool meets = std::isfinite(distance) && (drag.camera.orthographic || distance > 0);
    const glm::dvec3 there = meets ? ray.origin + distance * ray.direction - drag.pivot : ray.direction;
    const glm::dvec3 shift = there - glm::dot(there, normal) * normal;
    const double limit = farthest_shift * glm::length(way) * grip.pixel, length = glm::length(shift);
    const bool is_there = length == 0 || (meets && length <= limit);
    return is_there ? shift : shift * (limit / length);
}

glm::dvec3 shift_by_cursor(const TransformDrag& drag) {
    const glm::dvec2 way = drag.cursor - drag.start;
    const glm::dvec3 before = constrained(drag, drag.shift_before);
    if (way == glm::dvec2(0, 0)) return before;
    const Grip grip = grip_of(drag);
    const glm::dvec3 axis = axis_of(drag);
    switch (drag.constraint.kind) {
    case Constraint::Kind::axis:
        return before + shift_along(drag, grip, axis, way) * axis;
    case Constraint::Kind::plane:
        return before + shift_in_plane(drag, grip, axis, way);
    case Constraint::Kind::free:
        break;
    }
    return before + in_screen_plane(grip, way);
}

double factor_by_cursor(const TransformDrag& drag) {
    const Grip grip = grip_of(drag);
    const double start = glm::length(drag.start - grip.pivot);
    const double now = glm::length(drag.cursor - grip.pivot);
    // Begun upon the pivot, ten pixels count as one, so that it does not explode.
    return drag.factor_before * std::max(1 + (now - start) / std::max(start, 10.0), least_factor);
}

// What an axis is to the hand that turns about it.
struct Dial {
    glm::dvec3 axis, to_eye;
    double cosine; // of the angle between them
    // Nearly in the screen the axis is no dial but a roller.
    bool is_roller() const { return std::abs(cosine) < facing_enough; }
};

Dial dial_of(const TransformDrag& drag, const Grip& grip) {
    const glm::dvec3 axis = axis_of(drag);
    const glm::dvec3 to_eye = -ray_through(drag.camera, drag.viewport, grip.pivot).direction;
    return {axis, to_eye, glm::dot(axis, to_eye)};
}

// How far the cursor's way from one pixel to another turns about the axis.
double turn_between(const Grip& grip, const Dial& dial, glm::dvec2 from, glm::dvec2 to) {
    if (dial.is_roller()) {
        // What faces the eye goes with the hand.
        const glm::dvec3 motion = glm::cross(dial.axis, dial.to_eye);
        const glm::dvec2 across = glm::normalize(
            glm::dvec2(glm::dot(motion, grip.projector.right), -glm::dot(motion, grip.projector.up)));
        return glm::dot(to - from, across) / pixels_per_radian;
    }
    const glm::dvec2 a = from - grip.pivot;
    const glm::dvec2 b = to - grip.pivot;
    // y points down on the screen, so this is positive against the clock.
    const double angle = std::atan2(a.y * b.x - a.x * b.y, a.x * b.x + a.y * b.y);
    return dial.cosine > 0 ? angle : -angle;
}

// Lets the hand of a rotation go to the cursor; returns whether it went.
bool turn_to(TransformDrag& drag, glm::dvec2 cursor, double share) {
    const Grip grip = grip_of(drag);
    const Dial dial = dial_of(drag, grip);
    const auto has_angle = [&](glm::dvec2 pixel) {
        return dial.is_roller() || glm::length(pixel - grip.pivot) >= dead_pixels;
    };
    // Upon the pivot the hand waits where it last had an angle.
    if (!has_angle(cursor)) return false;
    if (has_angle(drag.hand)) drag.turned += share * turn_between(grip, dial, drag.hand, cursor);
    return true;
}

double round_to(double value, double step) {
    return step > 0 ? step * std::round(value / step) : value;
}

// The numbers typed are lengths along the axes that are left, in their order.
glm::dvec3 typed_shift(const TransformDrag& drag) {
    glm::dvec3 lengths(0.0);
    std::size_t field = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (leaves(drag.constraint, axis)) lengths[axis] = typed_number(drag, field++).value_or(0);
    return lengths;
}

glm::dvec3 shift_of(const TransformDrag& drag) {
    const glm::dquat frame = frame_of(drag);
    if (is_typed(drag)) return frame * typed_shift(drag);
    const glm::dvec3 shift = shift_by_cursor(drag);
    if (!drag.snap) return shift;
    glm::dvec3 parts = glm::conjugate(frame) * shift;
    for (int i = 0; i < 3; ++i) parts[i] = round_to(parts[i], drag.grid);
    return constrained(drag, frame * parts);
}

double angle_of(const TransformDrag& drag) {
    if (is_typed(drag)) return typed_number(drag).value_or(0) * pi / 180;
    return drag.snap ? round_to(drag.turned, snap_angle) : drag.turned;
}

double typed_factor(const TransformDrag& drag, std::size_t field) {
    return std::max(typed_number(drag, field).value_or(1), least_factor);
}

// Of all axes that are left.
double factor_of(const TransformDrag& drag) {
    if (is_typed(drag)) return typed_factor(drag, 0);
    const double factor = factor_by_cursor(drag);
    return std::max(drag.snap ? round_to(factor, snap_factor) : factor, least_factor);
}

glm::dvec3 factors_of(const TransformDrag& drag) {
    const bool each = drag.each_axis && is_typed(drag);
    const double even = each ? 1 : factor_of(drag);
    glm::dvec3 factors(1.0);
    std::size_t field = 0;
    for (int axis = 0; axis < 3; ++axis)
        if (leaves(drag.constraint, axis)) factors[axis] = each ? typed_factor(drag, field++) : even;
    return factors;
}

// 1, 2 or 5 times a power of ten.
double round_length(double length) {
    if (!(length > 0) || !std::isfinite(length)) return 1;
    const double power = std::pow(10.0, std::floor(std::log10(length)));
    const double digits = length / power;
    return (digits < 1.5 ? 1 : digits < 3.5 ? 2 : digits < 7.5 ? 5 : 10) * power;
}

} // namespace

TransformDrag begin_transform(TransformKind kind, const glm::dvec3& pivot, const glm::dquat& local_axes,
                              glm::dvec2 cursor, const Camera& camera, Viewport viewport) {
    TransformDrag drag;
    drag.kind = kind;
    drag.pivot = pivot;
    drag.local_axes = glm::normalize(local_axes);
    drag.start = drag.cursor = drag.hand = cursor;
    drag.camera = camera;
    drag.viewport = viewport;
    drag.screen_axis = glm::normalize(camera.orientation * glm::dvec3(0, 0, 1));
    drag.grid = round_length(grid_pixels * grip_of(drag).pixel);
    return drag;
}

void hold_transform(TransformDrag& drag, glm::dvec2 cursor, const Camera& camera, Viewport viewport) {
    if (drag.kind == TransformKind::translate) drag.shift_before = shift_by_cursor(drag);
    if (drag.kind == TransformKind::scale) drag.factor_before = factor_by_cursor(drag);
    drag.start = drag.cursor = drag.hand = cursor;
    drag.camera = camera;
    drag.viewport = viewport;
}

void follow_cursor(TransformDrag& drag, glm::dvec2 cursor, bool slow, const Camera& camera,
                   Viewport viewport) {
    if (drag.camera != camera || drag.viewport != viewport) hold_transform(drag, drag.hand, camera, viewport);
    const double share = slow ? 0.1 : 1.0;
    if (drag.kind == TransformKind::rotate && !turn_to(drag, cursor, share)) return;
    // A hand that was never slow is not summed up, so that it comes back to exactly where it was.
    drag.cursor = slow || drag.cursor != drag.hand ? drag.cursor + share * (cursor - drag.hand) : cursor;
    drag.hand = cursor;
}

namespace {

// What was typed for this axis is the length along it; where that is nothing, what was typed first.
void keep_length_along(TransformDrag& drag, int axis) {
    std::string& length = drag.typed[static_cast<std::size_t>(axis)];
    if (axis == 0 || length.empty()) return;
    drag.typed = {std::move(length), "", ""};
    drag.field = 0;
}

} // namespace

void press_axis(TransformDrag& drag, int axis, bool plane) {
    const Constraint::Kind kind = plane ? Constraint::Kind::plane : Constraint::Kind::axis;
    const Grip grip = grip_of(drag);
    const bool faced = dial_of(drag, grip).cosine >= 0;
    if (!plane && drag.kind != TransformKind::rotate && drag.constraint.kind == Constraint::Kind::free)
        keep_length_along(drag, axis);
    if (drag.constraint.kind != kind || drag.constraint.axis != axis)
        drag.constraint = {kind, axis, drag.own_first};
    else if (drag.constraint.local == drag.own_first)
        drag.constraint.local = !drag.own_first;
    else
        drag.constraint = {};
    // What was turned so far stays, and the way that it was seen to turn.
    if ((dial_of(drag, grip).cosine >= 0) != faced) drag.turned = -drag.turned;
}

Transform transform_of(const TransformDrag& drag) {
    Transform transform;
    transform.pivot = drag.pivot;
    switch (drag.kind) {
    case TransformKind::translate:
        transform.shift = shift_of(drag);
        break;
    case TransformKind::rotate:
        transform.axis = axis_of(drag);
        transform.angle = angle_of(drag);
        break;
    case TransformKind::scale:
        transform.scale = factors_of(drag);
        transform.axes = frame_of(drag);
        break;
    }
    return transform;
}

} // namespace knead

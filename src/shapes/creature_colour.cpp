// The coat of the creature: where it is orange, striped, cream or pink, and how its eyes look.

#include "shapes/creature.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knead {

namespace {

using Paint = Vec3d; // red, green, blue, 0 … 255

const Paint orange(238, 152, 66);
const Paint stripe(170, 84, 30);
const Paint cream(254, 240, 214);
const Paint pink(244, 158, 160);
const Paint nose_pink(222, 104, 116);
const Paint dark(58, 34, 26);

Paint mixed(const Paint& from, const Paint& to, double share) {
    return from + std::clamp(share, 0.0, 1.0) * (to - from);
}

// 0 below `from`, 1 above `to`, with no corner between; falls where from > to.
double rising(double from, double to, double value) {
    const double t = std::clamp((value - from) / (to - from), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

// 1 on stripes of the given period, 0 between them.
double striped(double place, double period) {
    return rising(0.2, 0.5, std::cos(2 * std::numbers::pi * place / period));
}

// 1 within a flat disc around (a, b), 0 outside.
double disc(double a, double b, double radius) {
    return rising(radius * 1.1, radius * 0.9, std::hypot(a, b));
}

Paint body_paint(const Vec3d& place, const Vec3d& normal) {
    const double behind = rising(0.1, -0.04, place.x());
    const double wave = 0.025 * std::cos(7 * place.y());
    Paint paint = mixed(orange, stripe, striped(place.z() + wave, 0.125) * behind);
    const double belly = std::hypot(place.y() / 0.2, (place.z() - 0.71) / 0.28);
    if (normal.x() > 0) paint = mixed(paint, cream, rising(1.08, 0.92, belly));
    return paint;
}

Paint head_paint(const Vec3d& place, const Vec3d& normal) {
    const double side = std::abs(place.y());
    const double on_top = rising(1.5, 1.54, place.z()) * rising(0.14, 0.12, side);
    const double on_cheek = rising(0.26, 0.29, side) * rising(0.55, 0.3, normal.x());
    Paint paint = mixed(orange, stripe, striped(place.y(), 0.105) * on_top);
    paint = mixed(paint, stripe, striped(place.z() - 0.25 * (side - 0.3), 0.09) * on_cheek);
    const double behind = rising(0.0, -0.2, normal.x()) * rising(1.5, 1.46, place.z());
    paint = mixed(paint, stripe, striped(place.z(), 0.12) * behind * (1 - on_cheek));
    const double face = std::hypot(place.y() / 0.2, (place.z() - 1.22) / 0.1);
    return normal.x() > 0 ? mixed(paint, cream, rising(1.1, 0.9, face)) : paint;
}

Paint muzzle_paint(const Vec3d& place, const Vec3d& normal) {
    if (normal.x() < 0.1) return cream;
    const double side = std::abs(place.y());
    const double middle_line = rising(0.009, 0.006, side) * rising(1.195, 1.2, place.z());
    const double smile = rising(0.009, 0.006, std::abs(std::hypot(side - 0.047, place.z() - 1.235) - 0.047));
    double ink =
        std::max(middle_line * rising(1.3, 1.29, place.z()), smile * rising(1.228, 1.222, place.z()));
    for (const auto& [y, z] : {std::pair(0.075, 1.275), std::pair(0.1, 1.255), std::pair(0.075, 1.24)})
        ink = std::max(ink, 0.7 * disc(side - y, place.z() - z, 0.009));
    return mixed(cream, dark, ink);
}

// Pink inside, on the side that faces ahead.
Paint ear_paint(const RoundTriangle& ear, const Vec3d& place, const Vec3d& normal) {
    const Vec3d one = ear.corners[1] - ear.corners[0];
    const Vec3d two = ear.corners[2] - ear.corners[0];
    const Vec3d across = one.cross(two);
    const Vec3d offset = place - ear.corners[0];
    const double b = offset.cross(two).dot(across) / across.squaredNorm();
    const double c = one.cross(offset).dot(across) / across.squaredNorm();
    const double inside = std::min({1 - b - c, b, c});
    return mixed(orange, pink, rising(0.04, 0.08, inside) * rising(0.3, 0.6, normal.x()));
}

Paint eye_paint(const RoundCone& ball, const Vec3d& place) {
    const double side = ball.from.y() > 0 ? 1 : -1;
    const Vec3d ahead = Vec3d(1, 0.22 * side, 0.02).normalized();
    const Vec3d left = Vec3d::UnitZ().cross(ahead).normalized();
    const Vec3d offset = (place - ball.from) / ball.from_radius;
    const double a = offset.dot(left);
    const double b = offset.dot(ahead.cross(left));
    Paint paint = mixed(Paint(252, 252, 248), Paint(96, 168, 74), disc(a, b, 0.46));
    paint = mixed(paint, Paint(150, 208, 96), disc(a, b, 0.38));
    paint = mixed(paint, Paint(22, 20, 24), disc(a / 0.24, b / 0.36, 1));
    paint = mixed(paint, Paint(255, 255, 255), disc(a - 0.13, b - 0.19, 0.12));
    const double from_middle = std::hypot(a, b);
    return mixed(mixed(orange, dark, rising(0.68, 0.64, from_middle)), paint, rising(0.6, 0.57, from_middle));
}

// Rings, a cream glove, and pads to knead with.
Paint arm_paint(const Vec3d& place, const Vec3d& normal, double along) {
    const double rings = striped(along, 0.15) * rising(0.2, 0.25, along) * rising(0.83, 0.8, along);
    Paint paint = mixed(mixed(orange, stripe, rings), cream, rising(0.87, 0.9, along));
    if (normal.x() < 0.3) return paint;
    const double y = std::abs(place.y());
    double pads = disc((y - 0.865) / 1.0, place.z() - 1.0, 0.034);
    for (const auto& [toe_y, toe_z] : {std::pair(0.9, 1.06), std::pair(0.937, 1.03), std::pair(0.932, 0.98)})
        pads = std::max(pads, disc(y - toe_y, place.z() - toe_z, 0.018));
    return mixed(paint, pink, pads);
}

Paint leg_paint(const Vec3d& place, const Vec3d& normal, double along) {
    const double rings = striped(along, 0.24) * rising(0.3, 0.35, along) * rising(0.72, 0.68, along);
    const Paint paint = mixed(mixed(orange, stripe, rings), cream, rising(0.78, 0.86, along));
    const double from_toe = std::abs(std::abs(std::abs(place.y()) - 0.2) - 0.027);
    const double toes =
        rising(0.009, 0.006, from_toe) * rising(0.5, 0.6, normal.x()) * rising(0.11, 0.1, place.z());
    return mixed(paint, dark, 0.8 * toes);
}

Paint tail_paint(double along) {
    const double rings = striped(along, 0.125) * rising(0.06, 0.1, along);
    return mixed(mixed(orange, stripe, rings), cream, rising(0.88, 0.9, along));
}

Paint paint_of(const NearestPiece& nearest, const Vec3d& place, const Vec3d& normal) {
    switch (nearest.piece->part) {
    case BodyPart::body:
        return body_paint(place, normal);
    case BodyPart::head:
        return head_paint(place, normal);
    case BodyPart::ear:
        return ear_paint(nearest.piece->triangle, place, normal);
    case BodyPart::muzzle:
        return muzzle_paint(place, normal);
    case BodyPart::nose:
        return nose_pink;
    case BodyPart::eye:
        return eye_paint(nearest.piece->cone, place);
    case BodyPart::arm:
        return arm_paint(place, normal, nearest.along);
    case BodyPart::leg:
        return leg_paint(place, normal, nearest.along);
    case BodyPart::tail:
        return tail_paint(nearest.along);
    }
    return orange;
}

} // namespace

Colour creature_colour(const Creature& creature, const Vec3d& place, const Vec3d& normal) {
    const Paint paint = paint_of(nearest_piece(creature, place), place, normal);
    Colour colour;
    for (std::size_t channel = 0; channel < 3; ++channel)
        colour[channel] = static_cast<std::uint8_t>(std::lround(paint[static_cast<Eigen::Index>(channel)]));
    return colour;
}

} // namespace knead

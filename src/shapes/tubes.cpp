// Closed tubes around a curve that lies on a torus: the torus itself, whose curve is a circle, and the knot.

#include "shapes/profile.h"
#include "shapes/shapes.h"
#include "shapes/simple_shapes.h"

#include <cmath>
#include <numbers>

namespace knead {

namespace {

constexpr double pi = std::numbers::pi;

// The curve ((R + r cos qt) cos pt, (R + r cos qt) sin pt, r sin qt): p turns around the z axis, q around the
// torus's own circle; with q = 0 it is a circle of radius R + r.
struct TorusCurve {
    double large;
    double small;
    double turns_around_axis;
    double turns_around_ring;
    double tube_radius;
};

// The curve at t, and a frame across it that closes after a round: the normal of the torus that it lies on,
// and what is at right angles to both.
struct Spine {
    Vec3d position;
    Vec3d along;      // unit
    double speed = 0; // length of the curve over t
    Vec3d curvature;  // points to the centre of the osculating circle, one over its radius long
    Vec3d across_one; // unit
    Vec3d across_two; // unit
};

Spine spine_at(const TorusCurve& curve, double t) {
    const double p = curve.turns_around_axis;
    const double q = curve.turns_around_ring;
    const double r = curve.small;
    const Vec3d outward(std::cos(p * t), std::sin(p * t), 0);
    const Vec3d onward(-outward.y(), outward.x(), 0);
    const Vec3d up(0, 0, 1);
    const double c = std::cos(q * t);
    const double s = std::sin(q * t);
    const double reach = curve.large + r * c;
    const Vec3d first = -r * q * s * outward + reach * p * onward + r * q * c * up;
    const Vec3d second =
        (-r * q * q * c - reach * p * p) * outward - 2 * r * q * s * p * onward - r * q * q * s * up;

    Spine spine;
    spine.position = reach * outward + r * s * up;
    spine.speed = first.norm();
    spine.along = first / spine.speed;
    spine.curvature = (second - second.dot(spine.along) * spine.along) / (spine.speed * spine.speed);
    spine.across_one = c * outward + s * up;
    spine.across_two = spine.along.cross(spine.across_one);
    return spine;
}

// The angle below which the fraction v of a ring's area lies. The area at an angle goes as 1 - a cos - b sin
// with a² + b² < 1 (it is larger on the outer side of a bend), so this is Kepler's equation with two terms:
// angle - a sin(angle) - b (1 - cos(angle)) = 2πv, by Newton's method kept inside a shrinking bracket.
double ring_angle(double v, double a, double b) {
    const double wanted = 2 * pi * v;
    double low = 0;
    double high = 2 * pi;
    double angle = wanted;
    for (int step = 0; step < 60; ++step) {
        const double excess = angle - a * std::sin(angle) - b * (1 - std::cos(angle)) - wanted;
        (excess > 0 ? high : low) = angle;
        if (std::abs(excess) < 1e-13) break;
        double next = angle - excess / (1 - a * std::cos(angle) - b * std::sin(angle));
        if (next <= low || next >= high) next = 0.5 * (low + high);
        angle = next;
    }
    return angle;
}

SurfacePoint tube_point(const TorusCurve& curve, double t, double v) {
    const Spine spine = spine_at(curve, t);
    const double a = curve.tube_radius * spine.curvature.dot(spine.across_one);
    const double b = curve.tube_radius * spine.curvature.dot(spine.across_two);
    const double angle = ring_angle(v, a, b);
    const Vec3d normal = std::cos(angle) * spine.across_one + std::sin(angle) * spine.across_two;
    return {spine.position + curve.tube_radius * normal, normal};
}

std::vector<SurfacePatch> tube_patches(const TorusCurve& curve, double gradient) {
    SurfacePatch tube;
    tube.low = 0;
    tube.high = 2 * pi;
    // A tube's area is its length times its girth whatever its bends (Pappus).
    tube.area = [=](double t) { return spine_at(curve, t).speed * 2 * pi * curve.tube_radius; };
    tube.width = [=](double) { return 2 * pi * curve.tube_radius; };
    tube.density = [=](double t) { return gradient_density(gradient, 0.5 + 0.5 * std::cos(t)); };
    tube.point = [=](double t, double v) { return tube_point(curve, t, v); };
    return {tube};
}

constexpr TorusCurve knot_curve{2, 0.6, 2, 3, knot_tube_radius};

} // namespace

Vec3d knot_spine(double t) {
    return spine_at(knot_curve, t).position;
}

std::vector<SurfacePatch> torus_patches(double gradient) {
    return tube_patches({1, 0, 1, 0, 0.35}, gradient);
}

std::vector<SurfacePatch> knot_patches(double gradient) {
    return tube_patches(knot_curve, gradient);
}

} // namespace knead

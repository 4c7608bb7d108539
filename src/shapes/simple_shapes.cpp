#include "shapes/simple_shapes.h"

#include "shapes/profile.h"

#include <array>
#include <cmath>
#include <numbers>

namespace knead {

namespace {

constexpr double pi = std::numbers::pi;

std::function<double(double)> rising_density(double gradient, double low, double high) {
    return [=](double u) { return gradient_density(gradient, (u - low) / (high - low)); };
}

std::function<double(double)> always(double value) {
    return [=](double) { return value; };
}

SurfacePatch bar_cap(double z, double density) {
    SurfacePatch cap;
    cap.low = -half_width;
    cap.high = half_width;
    cap.area = cap.width = always(1);
    cap.density = always(density);
    cap.closed = false;
    cap.point = [=](double y, double v) {
        return SurfacePoint{{v - half_width, y, z}, {0, 0, z > 0 ? 1.0 : -1.0}};
    };
    return cap;
}

// The point at `way` (0 … 4) around the bar's square section.
SurfacePoint bar_side_point(double z, double way) {
    const double side = std::min(std::floor(way), 3.0);
    const double along = way - side - half_width;
    static constexpr std::array<std::array<double, 2>, 4> outward{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    const auto& [nx, ny] = outward[static_cast<std::size_t>(side)];
    return {{half_width * nx - along * ny, half_width * ny + along * nx, z}, {nx, ny, 0}};
}

} // namespace

std::vector<SurfacePatch> plane_patches(double gradient) {
    SurfacePatch square;
    square.area = square.width = always(1);
    square.density = rising_density(gradient, 0, 1);
    square.closed = false;
    square.point = [](double x, double y) { return SurfacePoint{{x, y, 0}, {0, 0, 1}}; };
    return {square};
}

std::vector<SurfacePatch> bar_patches(double gradient) {
    SurfacePatch sides;
    sides.low = -half_length;
    sides.high = half_length;
    sides.area = sides.width = always(4);
    sides.density = rising_density(gradient, -half_length, half_length);
    sides.point = [](double z, double v) { return bar_side_point(z, 4 * v); };
    return {bar_cap(-half_length, 1), sides, bar_cap(half_length, gradient)};
}

std::vector<SurfacePatch> cylinder_patches(double gradient) {
    SurfacePatch tube;
    tube.low = -half_length;
    tube.high = half_length;
    tube.area = tube.width = always(2 * pi * half_width);
    tube.density = rising_density(gradient, -half_length, half_length);
    tube.point = [](double z, double v) {
        const Vec3d normal(std::cos(2 * pi * v), std::sin(2 * pi * v), 0);
        return SurfacePoint{half_width * normal + Vec3d(0, 0, z), normal};
    };
    return {tube};
}

std::vector<SurfacePatch> sphere_patches(double gradient) {
    SurfacePatch ball;
    ball.low = -1;
    ball.high = 1;
    ball.area = always(2 * pi); // equal slices of a sphere have equal areas (Archimedes)
    ball.width = [](double z) { return 2 * pi * std::sqrt(std::max(0.0, 1 - z * z)); };
    ball.density = rising_density(gradient, -1, 1);
    ball.point = [](double z, double v) {
        const double across = std::sqrt(std::max(0.0, 1 - z * z));
        const Vec3d place(across * std::cos(2 * pi * v), across * std::sin(2 * pi * v), z);
        return SurfacePoint{place, place};
    };
    return {ball};
}

} // namespace knead

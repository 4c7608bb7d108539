#include "shapes/shapes.h"

#include "base/error.h"
#include "base/require.h"
#include "shapes/creature.h"
#include "shapes/purposes.h"
#include "shapes/random.h"
#include "shapes/scanner.h"
#include "shapes/simple_shapes.h"
#include "shapes/staged_loop.h"

#include <array>
#include <cmath>
#include <numbers>
#include <utility>

namespace knead {

namespace {

constexpr std::array<std::pair<std::string_view, Shape>, 8> named_shapes{{
    {"plane", Shape::plane},
    {"bar", Shape::bar},
    {"cylinder", Shape::cylinder},
    {"sphere", Shape::sphere},
    {"torus", Shape::torus},
    {"solid-bar", Shape::solid_bar},
    {"knot", Shape::knot},
    {"creature", Shape::creature},
}};

// The size of a shape with a formula.
struct Extent {
    Vec3d lowest;
    Vec3d highest;
    double measure = 0; // area, or a solid's volume
};

Extent extent_of(Shape shape) {
    constexpr double pi = std::numbers::pi;
    const auto centred = [](double x, double y, double z) {
        return std::pair(Vec3d(-x, -y, -z), Vec3d(x, y, z));
    };
    const auto make = [](const std::pair<Vec3d, Vec3d>& box, double measure) {
        return Extent{box.first, box.second, measure};
    };
    const double knot_reach = 2.6 + knot_tube_radius;
    switch (shape) {
    case Shape::plane:
        return {Vec3d::Zero(), {1, 1, 0}, 1};
    case Shape::bar:
        return make(centred(0.5, 0.5, 2.5), 22);
    case Shape::cylinder:
        return make(centred(0.5, 0.5, 2.5), 5 * pi);
    case Shape::sphere:
        return make(centred(1, 1, 1), 4 * pi);
    case Shape::torus:
        return make(centred(1.35, 1.35, 0.35), 4 * pi * pi * 0.35);
    case Shape::solid_bar:
        return make(centred(0.5, 0.5, 2.5), 5);
    case Shape::knot:
        return make(centred(knot_reach, knot_reach, 0.6 + knot_tube_radius),
                    27.651 * 2 * pi * knot_tube_radius);
    case Shape::creature:
        break;
    }
    require(false, "a shape without a size");
    return {};
}

std::vector<SurfacePatch> patches_of(Shape shape, double gradient) {
    switch (shape) {
    case Shape::plane:
        return plane_patches(gradient);
    case Shape::bar:
        return bar_patches(gradient);
    case Shape::cylinder:
        return cylinder_patches(gradient);
    case Shape::sphere:
        return sphere_patches(gradient);
    case Shape::torus:
        return torus_patches(gradient);
    case Shape::knot:
        return knot_patches(gradient);
    case Shape::solid_bar:
    case Shape::creature:
        break;
    }
    require(false, "a shape without patches");
    return {};
}

void check(const ShapeOptions& options) {
    const auto refuse = [](const char* words) { throw Error(Trouble::usage, "", words); };
    if (options.points < 1) refuse("--points must be at least 1");
    if (options.points >= no_index) refuse("--points must be below 4294967295");
    const double noise = options.noise.value_or(0);
    constexpr double most_noise = 1e6;
    if (!(noise >= 0 && noise <= most_noise))
        refuse("--noise must be between 0 and a million: so many times the point spacing");
    const double outliers = options.outliers.value_or(0);
    if (!(outliers >= 0 && outliers < 1))
        refuse("--outliers must be at least 0 and below 1: a fraction of the points");
    if (!(options.gradient >= 1) || options.gradient > 1e6)
        refuse("--gradient must lie between 1 and 1000000: the density at its highest over its lowest");
}

std::size_t strays_of(const ShapeOptions& options, double fraction_by_default) {
    const double fraction = options.outliers.value_or(fraction_by_default);
    const auto strays = static_cast<std::size_t>(fraction * static_cast<double>(options.points));
    return std::min(strays, options.points - 1);
}

void add_strays(const Extent& extent, std::size_t first, const ShapeOptions& options, PointColumns& columns) {
    const double margin = 0.1 * (extent.highest - extent.lowest).norm();
    const Vec3d lowest = extent.lowest - Vec3d::Constant(margin);
    const Vec3d size = extent.highest - extent.lowest + Vec3d::Constant(2 * margin);
    for (std::size_t i = first; i < options.points; ++i) {
        Random random(options.seed, purpose_stray, i);
        Vec3d place;
        for (int axis = 0; axis < 3; ++axis) place[axis] = lowest[axis] + size[axis] * random.uniform();
        put_point(columns, i, place, random.direction());
    }
}

PointCloud make_creature_scan(const ShapeOptions& options, Workers& workers, Progress& progress) {
    constexpr double usual_noise = 0.3;
    constexpr double usual_outliers = 0.002;
    constexpr double normals_per_noise = 0.15; // radians of the normals' error for a spacing of noise
    const double noise = options.noise.value_or(usual_noise);
    ScanOptions scanning;
    scanning.points = options.points;
    scanning.seed = options.seed;
    scanning.noise = noise * std::sqrt(creature_area / static_cast<double>(options.points));
    scanning.normal_noise = noise * normals_per_noise;
    scanning.strays = strays_of(options, usual_outliers);
    scanning.gradient = options.gradient;
    return scan(creature_body(), creature_viewpoints(), scanning, workers, progress);
}

} // namespace

std::optional<Shape> shape_named(std::string_view name) {
    for (const auto& [known, shape] : named_shapes)
        if (known == name) return shape;
    return std::nullopt;
}

std::string_view name_of(Shape shape) {
    for (const auto& [name, known] : named_shapes)
        if (known == shape) return name;
    require(false, "a shape without a name");
    return {};
}

std::string shape_names() {
    std::string names;
    for (const auto& [name, shape] : named_shapes) names.append(names.empty() ? "" : ", ").append(name);
    return names;
}

PointCloud make_shape(Shape shape, const ShapeOptions& options, Workers& workers, Progress& progress) {
    check(options);
    if (shape == Shape::creature) return make_creature_scan(options, workers, progress);

    const bool solid = shape == Shape::solid_bar;
    const Extent extent = extent_of(shape);
    const double share = extent.measure / static_cast<double>(options.points);
    SamplingOptions sampling;
    sampling.points = options.points - strays_of(options, 0);
    sampling.seed = options.seed;
    sampling.noise = options.noise.value_or(0) * (solid ? std::cbrt(share) : std::sqrt(share));
    PointColumns columns =
        make_columns(options.points, solid ? WithNormals::no : WithNormals::yes, WithColours::no);
    if (solid)
        sample_solid_bar(options.gradient, sampling, columns, workers, progress);
    else
        sample_patches(patches_of(shape, options.gradient), sampling, columns, workers, progress);
    add_strays(extent, sampling.points, options, columns);
    return finish(std::move(columns));
}

} // namespace knead

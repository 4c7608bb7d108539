#include "shapes/depth_image.h"

#include "shapes/profile.h"
#include "shapes/purposes.h"
#include "shapes/random.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knead {

namespace {

constexpr std::size_t block_side = 16; // rays that are led to the body together

struct DepthRange {
    double nearest = 0;
    double farthest = 0;
};

DepthRange depths_of_box(const ScannedBody& body, const View& view) {
    const Vec3d middle = 0.5 * (body.lowest + body.highest);
    const double reach = 0.5 * (body.highest - body.lowest).norm();
    const double depth = (middle - view.eye).dot(view.ahead);
    return {std::max(0.0, depth - reach), depth + reach};
}

Vec3d direction_through(const View& view, double row, double column) {
    const double a = view.left + column * view.pixel;
    const double b = view.top - row * view.pixel;
    return view.ahead + a * view.right + b * view.up;
}

// How far all rays of a block may go at once; past `range.farthest` when none of them meets the body. At
// depth z they are within z · spread of the ray in the middle, so the body is at least (its distance there -
// z · spread) away from each.
double lead_block(const ScannedBody& body, const View& view, double row, double column,
                  const DepthRange& range) {
    constexpr double half = 0.5 * block_side;
    const ScanRay middle{view.eye, direction_through(view, row + half, column + half)};
    const double spread = std::numbers::sqrt2 * half * view.pixel;
    const double longest = middle.direction.norm() + spread;
    double depth = range.nearest;
    while (depth < range.farthest) {
        const double free = body.distance(middle.at(depth)) - depth * spread;
        if (free < 0.5 * depth * spread) break;
        depth += free / longest;
    }
    return depth;
}

// The depth of the first surface on the ray, 0 for none.
double trace_ray(const ScannedBody& body, const ScanRay& ray, double depth, double farthest) {
    constexpr int most_steps = 200;
    constexpr double touching = 2e-6;
    const double length = ray.direction.norm();
    for (int step = 0; step < most_steps && depth < farthest; ++step) {
        const double distance = body.distance(ray.at(depth));
        depth += distance / length;
        if (distance < touching) return depth;
    }
    return 0;
}

// Whether the scanner gets the return: steeply met surfaces send it, grazed ones swallow it.
bool comes_back(const ScannedBody& body, const ScanRay& ray, double depth, double gradient, Random& random) {
    constexpr double never_below = 0.06; // cosine of the angle to the normal
    constexpr double always_above = 0.35;
    const Vec3d place = ray.at(depth);
    const double cosine = -field_normal(body.distance, place).dot(ray.direction.normalized());
    const double chance = std::clamp((cosine - never_below) / (always_above - never_below), 0.0, 1.0);
    if (random.uniform() >= chance * chance * (3 - 2 * chance)) return false;
    const double height = (place.z() - body.lowest.z()) / (body.highest.z() - body.lowest.z());
    return gradient == 1 || random.uniform() < gradient_density(gradient, height) / gradient;
}

struct Block {
    std::size_t row = 0;
    std::size_t column = 0;
};

void trace_block(const ScannedBody& body, const Block& block, const DepthRange& range, double gradient,
                 DepthImage& image) {
    const View& view = image.view;
    const double start =
        lead_block(body, view, static_cast<double>(block.row), static_cast<double>(block.column), range);
    if (start >= range.farthest) return;
    const std::size_t row_end = std::min(view.rows, block.row + block_side);
    const std::size_t column_end = std::min(view.columns, block.column + block_side);
    for (std::size_t row = block.row; row < row_end; ++row) {
        for (std::size_t column = block.column; column < column_end; ++column) {
            const ScanRay ray = ray_of(view, image.seed, row, column);
            const double depth = trace_ray(body, ray, start, range.farthest);
            if (depth == 0) continue;
            const std::size_t at = row * view.columns + column;
            Random random(image.seed, purpose_return, at);
            const bool back = comes_back(body, ray, depth, gradient, random);
            image.depths[at] = static_cast<float>(back ? depth : -depth);
        }
    }
}

} // namespace

View view_of(const ScannedBody& body, const Viewpoint& viewpoint, double pixel) {
    View view;
    view.eye = viewpoint.eye;
    view.ahead = (0.5 * (body.lowest + body.highest) - viewpoint.eye).normalized();
    view.right = view.ahead.cross(Vec3d::UnitZ()).normalized();
    view.up = view.right.cross(view.ahead);
    view.pixel = pixel / viewpoint.sharpness;
    double right = -1e9;
    double bottom = 1e9;
    view.left = 1e9;
    view.top = -1e9;
    for (int corner = 0; corner < 8; ++corner) {
        const Vec3d place((corner & 1) != 0 ? body.highest.x() : body.lowest.x(),
                          (corner & 2) != 0 ? body.highest.y() : body.lowest.y(),
                          (corner & 4) != 0 ? body.highest.z() : body.lowest.z());
        const Vec3d offset = place - view.eye;
        const double depth = offset.dot(view.ahead);
        view.left = std::min(view.left, offset.dot(view.right) / depth);
        right = std::max(right, offset.dot(view.right) / depth);
        bottom = std::min(bottom, offset.dot(view.up) / depth);
        view.top = std::max(view.top, offset.dot(view.up) / depth);
    }
    view.rows = static_cast<std::size_t>(std::ceil((view.top - bottom) / view.pixel));
    view.columns = static_cast<std::size_t>(std::ceil((right - view.left) / view.pixel));
    view.size = (right - view.left) * (view.top - bottom) * viewpoint.sharpness * viewpoint.sharpness;
    return view;
}

ScanRay ray_of(const View& view, std::uint64_t seed, std::size_t row, std::size_t column) {
    Random random(seed, purpose_ray, row * view.columns + column);
    const double in_row = static_cast<double>(row) + random.between(0.25, 0.75);
    const double in_column = static_cast<double>(column) + random.between(0.25, 0.75);
    return {view.eye, direction_through(view, in_row, in_column)};
}

float DepthImage::neighbour_depth(std::size_t row, std::size_t column) const {
    if (column + 1 < view.columns && at(row, column + 1) > 0) return at(row, column + 1);
    if (column > 0 && at(row, column - 1) > 0) return at(row, column - 1);
    if (row + 1 < view.rows && at(row + 1, column) > 0) return at(row + 1, column);
    if (row > 0 && at(row - 1, column) > 0) return at(row - 1, column);
    return 0;
}

DepthImage trace_image(const ScannedBody& body, const View& view, const TraceOptions& options,
                       const StagePart& part, Workers& workers, Progress& progress) {
    DepthImage image{view, options.seed, std::vector<float>(view.rows * view.columns)};
    const DepthRange range = depths_of_box(body, view);
    const std::size_t block_rows = (view.rows + block_side - 1) / block_side;
    const std::size_t block_columns = (view.columns + block_side - 1) / block_side;
    staged_loop(workers, progress, part, block_rows * block_columns, [&](std::size_t at) {
        const Block block{at / block_columns * block_side, at % block_columns * block_side};
        trace_block(body, block, range, options.gradient, image);
    });
    return image;
}

} // namespace knead

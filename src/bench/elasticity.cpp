#include "bench/elasticity.h"

#include "base/types.h"
#include "bench/made_cloud.h"
#include "bench/posing.h"

#include <cmath>

namespace knead {

namespace {

constexpr double ratios[] = {-0.9, -0.5, 0.0, 0.3, 0.45, 0.49};
constexpr std::size_t half_points = 10'000;
constexpr double joint = 2.5; // half the length of a made bar
constexpr double free_half = 4.5;
constexpr double stretch = 1.3;
constexpr double slab_half = 0.5;
constexpr unsigned settle_limit = 1000;

// Two made bars in a row: long enough that the grip at the ends is not felt in the middle. The shell's two
// caps at the joint are left out.
PointCloud long_bar(bool solid, Workers& workers, Progress& progress) {
    const PointCloud bar = made_cloud(solid ? Shape::solid_bar : Shape::bar, half_points, workers, progress);
    std::vector<float> positions;
    for (const double side : {-1.0, 1.0})
        for (std::size_t i = 0; i < bar.size(); ++i) {
            const Vec3d place = bar.file_position(i);
            const bool on_cap = !solid && place.z() >= joint * (1 - 1e-6);
            if (on_cap) continue;
            // The upper half is the lower one's mirror image, turned upside down.
            const Vec3f moved = Vec3d(place.x(), place.y(), side * (joint - place.z())).cast<float>();
            positions.insert(positions.end(), moved.begin(), moved.end());
        }
    return make_cloud(positions);
}

StretchResult stretch_bar(const DeformationTask& bar, const std::optional<std::uint64_t>& samples,
                          double poisson, Workers& workers, Upsampler& upsampler, Progress& progress) {
    Settings settings = with_samples(samples);
    settings.poisson = poisson;
    const auto document = open_task(bar, settings, workers, upsampler);
    document->drag(whole_motion(bar), "", progress);
    const Settling settling = settle(*document, settle_limit, progress);

    StretchResult result;
    result.points = bar.cloud.size();
    result.asked_samples = samples;
    result.asked = poisson;
    result.iterations = settling.iterations;
    result.at_rest = settling.at_rest;
    // The middle of the stretched bar is the middle of the bar at rest.
    const SlabStretch slab = slab_stretch(bar.cloud.positions, document->positions(progress), slab_half);
    result.along = slab.along;
    result.measured = -std::log(slab.across) / std::log(slab.along);
    return result;
}

} // namespace

DeformationTask stretched_bar(bool solid, Workers& workers, Progress& progress) {
    DeformationTask task;
    task.name = solid ? "solid" : "shell";
    task.cloud = long_bar(solid, workers, progress);
    for (Index i = 0; i < task.cloud.size(); ++i) {
        const double z = task.cloud.file_position(i).z();
        if (z <= -free_half) task.fixed.push_back(i);
        if (z >= free_half) task.handle.push_back(i);
    }
    task.pose.translate = Vec3d(0, 0, 2 * free_half * (stretch - 1));
    return task;
}

std::vector<StretchResult> evaluate_elasticity(std::span<const std::optional<std::uint64_t>> samples,
                                               Workers& workers, Upsampler& upsampler, Progress& progress) {
    std::vector<StretchResult> results;
    for (const bool solid : {false, true}) {
        const DeformationTask bar = stretched_bar(solid, workers, progress);
        for (const auto& count : samples)
            for (const double poisson : ratios) {
                results.push_back(stretch_bar(bar, count, poisson, workers, upsampler, progress));
                results.back().solid = solid;
            }
    }
    return results;
}

SlabStretch slab_stretch(std::span<const float> rest, std::span<const float> posed, double half_height) {
    Vec3d middle_rest = Vec3d::Zero(), middle_posed = Vec3d::Zero();
    std::size_t points = 0;
    const auto at = [](std::span<const float> positions, std::size_t i) {
        return Vec3d(positions[i], positions[i + 1], positions[i + 2]);
    };
    const auto for_slab = [&](auto&& take) {
        for (std::size_t i = 0; i + 3 <= rest.size(); i += 3)
            if (std::abs(double{rest[i + 2]}) <= half_height) take(at(rest, i), at(posed, i));
    };
    for_slab([&](const Vec3d& p, const Vec3d& x) {
        middle_rest += p;
        middle_posed += x;
        ++points;
    });
    if (points == 0) return {};
    middle_rest /= static_cast<double>(points);
    middle_posed /= static_cast<double>(points);
    Vec3d squares = Vec3d::Zero(), products = Vec3d::Zero();
    for_slab([&](const Vec3d& p, const Vec3d& x) {
        squares += (p - middle_rest).cwiseAbs2();
        products += (p - middle_rest).cwiseProduct(x - middle_posed);
    });
    return {products.z() / squares.z(), (products.x() + products.y()) / (squares.x() + squares.y())};
}

} // namespace knead

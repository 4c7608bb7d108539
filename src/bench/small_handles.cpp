#include "bench/small_handles.h"

#include "bench/made_cloud.h"
#include "bench/posing.h"
#include "graph/shading_normals.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace knead {

namespace {

constexpr unsigned settle_limit = 1000;
constexpr std::size_t points = 40'000;
constexpr double moved = 0.01; // of D: points that went further count for normals

// Of normals and surface, vertex by vertex, where nothing holds a point and it moved.
Askew askew_of(Document& document, const std::vector<float>& posed, Workers& workers, Progress& progress) {
    const Pipeline& pipeline = document.pipeline();
    const PointOrder& order = pipeline.order();
    const std::vector<float> normals = document.normals(progress);
    std::vector<float> positions;
    std::vector<std::size_t> counted;
    for (Index v = 0; v < order.vertices(); ++v) {
        const std::size_t point = order.file_index[order.first_point[v]];
        const Vec3d place = point_at(posed, point);
        const Vec3d way = place - point_at(document.cloud().positions, point);
        for (const double coordinate : place) positions.push_back(static_cast<float>(coordinate));
        if (pipeline.labels().vertex[v] == no_index && way.norm() > moved * document.bounds().diagonal())
            counted.push_back(v);
    }
    const std::vector<float> surface = shading_normals(pipeline.graph(), positions, workers);
    std::vector<double> degrees;
    for (const std::size_t v : counted) {
        const Vec3d normal = point_at(normals, order.file_index[order.first_point[v]]);
        const double cosine = std::abs(normal.dot(point_at(surface, v)));
        degrees.push_back(180 / std::numbers::pi * std::acos(std::min(1.0, cosine)));
    }
    if (degrees.empty()) return {};
    std::ranges::sort(degrees);
    return {degrees[degrees.size() / 2], degrees[degrees.size() * 9 / 10]};
}

// What is nearer to the middle of the unit square moves, what is further away than `free` stays.
DeformationTask disc_task(const std::string& name, const PointCloud& plane, double radius, double free,
                          const HandlePose& pose) {
    DeformationTask task;
    task.name = name;
    task.cloud = plane;
    task.pivot = Vec3d(0.5, 0.5, 0);
    task.pose = pose;
    double nearest = radius;
    for (Index i = 0; i < plane.size(); ++i) {
        const double away = (plane.file_position(i) - task.pivot).norm();
        if (away > free) task.fixed.push_back(i);
        if (radius > 0 && away <= radius) task.handle.push_back(i);
        if (radius == 0 && (task.handle.empty() || away < nearest)) task.handle = {i}, nearest = away;
    }
    return task;
}

// What lies within .2 along x and few points to the sides moves, and what is further away than `free` stays.
DeformationTask line_task(const std::string& name, const PointCloud& plane, double free,
                          const HandlePose& pose) {
    DeformationTask task = disc_task(name, plane, 0, free, pose);
    task.handle.clear();
    for (Index i = 0; i < plane.size(); ++i) {
        const Vec3d way = plane.file_position(i) - task.pivot;
        if (std::abs(way.x()) <= 0.2 && std::abs(way.y()) <= 0.005) task.handle.push_back(i);
    }
    return task;
}

// One edge of the square stays, and a point in its middle turns the rest.
DeformationTask point_turned(const PointCloud& plane) {
    DeformationTask task =
        disc_task("a point turned by 60°, an edge held", plane, 0, 1, turned(60, Vec3d::UnitY()));
    for (Index i = 0; i < plane.size(); ++i)
        if (plane.file_position(i).x() <= 0.05) task.fixed.push_back(i);
    return task;
}

HandlePose scaled(const Vec3d& times) {
    HandlePose pose;
    pose.scale = times;
    return pose;
}

// Its foot stays, its head is free.
DeformationTask longer_tube(Workers& workers, Progress& progress) {
    DeformationTask task;
    task.name = "a tube's middle, 3 times as long";
    task.cloud = made_cloud(Shape::cylinder, points, workers, progress);
    task.pose = scaled({1, 1, 3});
    for (Index i = 0; i < task.cloud.size(); ++i) {
        const double z = task.cloud.file_position(i).z();
        if (z <= -2.3) task.fixed.push_back(i);
        if (std::abs(z) <= 0.3) task.handle.push_back(i);
    }
    return task;
}

} // namespace

std::vector<SmallResult> pose_small(const DeformationTask& task, std::span<const std::uint64_t> samples,
                                    Workers& workers, Upsampler& upsampler, Progress& progress) {
    std::vector<std::optional<std::uint64_t>> counts{std::nullopt};
    counts.insert(counts.end(), samples.begin(), samples.end());
    std::vector<SmallResult> results;
    std::vector<float> yardstick;
    for (const std::optional<std::uint64_t>& asked : counts) {
        const auto document = open_task(task, with_samples(asked), workers, upsampler);
        document->drag(whole_motion(task), task.name, progress);
        const Settling settling = settle(*document, settle_limit, progress);
        const std::vector<float> posed = document->positions(progress);
        if (!asked) yardstick = posed;
        SmallResult& result = results.emplace_back();
        result.name = task.name;
        result.points = task.cloud.size();
        result.asked = asked;
        result.samples = document->pipeline().samples().size();
        result.deviation = deviation_between(posed, yardstick, document->bounds().diagonal());
        result.askew = askew_of(*document, posed, workers, progress);
        result.iterations = settling.iterations;
        result.at_rest = settling.at_rest;
    }
    return results;
}

std::vector<SmallResult> evaluate_small_handles(Workers& workers, Upsampler& upsampler, Progress& progress) {
    constexpr double whole = 0.45; // the radius of what is free of the whole plane
    const PointCloud plane = made_cloud(Shape::plane, points, workers, progress);
    const double diagonal = bounds_of(plane).diagonal();
    const HandlePose up = shifted({0, 0, 0.1 * diagonal}), a_little = shifted({0, 0, 0.04 * diagonal});
    const DeformationTask tasks[] = {
        disc_task("a point, lifted", plane, 0, whole, up),
        disc_task("a point, aside", plane, 0, whole, shifted({0.05 * diagonal, 0, 0})),
        point_turned(plane),
        disc_task("a disc of 3 %, lifted", plane, 0.03 * diagonal, whole, up),
        disc_task("the same in a region of 10 %", plane, 0.03 * diagonal, 0.1 * diagonal, a_little),
        disc_task("a point in a region of 5 %", plane, 0, 0.05 * diagonal, a_little),
        disc_task("a disc of 6 %, lifted", plane, 0.06 * diagonal, whole, up),
        disc_task("a disc of 6 %, tilted by 40°", plane, 0.06 * diagonal, whole, turned(40, Vec3d::UnitX())),
        disc_task("a disc of 6 %, turned by 90°", plane, 0.06 * diagonal, whole, turned(90, Vec3d::UnitZ())),
        disc_task("a disc of 6 %, twice as large", plane, 0.06 * diagonal, whole, scaled(Vec3d::Constant(2))),
        line_task("a line, lifted", plane, whole, up),
        line_task("a line, tipped by 40°", plane, whole, turned(40, Vec3d::UnitY())),
        longer_tube(workers, progress),
    };
    const std::uint64_t samples[] = {1000, 5000};
    std::vector<SmallResult> results;
    for (const DeformationTask& task : tasks)
        for (SmallResult& result : pose_small(task, samples, workers, upsampler, progress))
            results.push_back(std::move(result));
    return results;
}

} // namespace knead

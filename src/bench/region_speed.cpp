#include "bench/region_speed.h"

#include "base/stopwatch.h"
#include "bench/automatic_handles.h"
#include "bench/posing.h"
#include "upsample/devices.h"

#include <algorithm>
#include <memory>
#include <numeric>

namespace knead {

namespace {

constexpr int frames = 40;
constexpr double degrees = 30;
constexpr double share_of_handle = 0.01;

// All points that are finite, the nearest to the middle of these first.
std::vector<Index> by_distance(const PointCloud& cloud, const std::vector<Index>& around) {
    Vec3d middle = Vec3d::Zero();
    for (const Index i : around) middle += point_at(cloud.positions, i) / static_cast<double>(around.size());
    std::vector<double> distance(cloud.size());
    std::vector<Index> points;
    for (Index i = 0; i < cloud.size(); ++i) {
        if (!is_finite(cloud, i)) continue;
        distance[i] = (point_at(cloud.positions, i) - middle).squaredNorm();
        points.push_back(i);
    }
    std::ranges::stable_sort(points, {}, [&](Index i) { return distance[i]; });
    return points;
}

std::vector<Index> first_ones(const std::vector<Index>& points, double share) {
    const auto count =
        std::max<std::size_t>(1, static_cast<std::size_t>(share * static_cast<double>(points.size())));
    std::vector<Index> first(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(count));
    std::ranges::sort(first);
    return first;
}

// A document that is dragged while it is measured.
struct Dragged {
    UpsamplerChoice choice;
    std::unique_ptr<Document> document;
    std::vector<double> seconds;

    void begin(const DeformationTask& task, const std::vector<Index>& handle, Progress& progress) {
        document->declare(handle_line("middle", HandleRole::moving, handle), task.name);
        document->begin_drag("middle", task.pivot, task.name, progress);
    }
    void follow(const HandlePose& pose, const std::string& place, Progress& progress) {
        const Stopwatch clock;
        document->drag_frame(pose, place, progress);
        seconds.push_back(clock.seconds());
    }
    RegionSpeed::Frames result() {
        std::vector<double> upsampling = document->log().upsample;
        upsampling.erase(upsampling.begin());
        seconds.erase(seconds.begin());
        document->abandon();
        return {document->pipeline().samples().size(), summarize(std::move(seconds)),
                summarize(std::move(upsampling))};
    }
};

Dragged opened(const DeformationTask& task, std::uint64_t samples, const Table1Options& options,
               Workers& workers) {
    Dragged dragged{make_upsampler(options.device, workers, options.threads), nullptr, {}};
    dragged.document =
        std::make_unique<Document>(task.cloud, with_samples(samples), workers, *dragged.choice.upsampler);
    dragged.document->declare(handle_line("fixed", HandleRole::fixed, task.fixed), task.name);
    return dragged;
}

} // namespace

RegionSpeed measure_region(const DeformationTask& task, double share, std::uint64_t samples,
                           const Table1Options& options, Workers& workers, Progress& progress) {
    const std::vector<Index> points = by_distance(task.cloud, task.handle);
    const std::vector<Index> handle = first_ones(points, share_of_handle), around = first_ones(points, share);
    Dragged whole = opened(task, samples, options, workers), region = opened(task, samples, options, workers);
    region.document->declare(handle_line("around", HandleRole::region_of_interest, around), task.name);
    whole.begin(task, handle, progress);
    region.begin(task, handle, progress);
    const Eigen::AngleAxisd turn(task.pose.rotate);
    for (int frame = 1; frame <= frames; ++frame) {
        const HandlePose pose = turned(degrees * frame / frames, turn.axis());
        for (Dragged* dragged : {&whole, &region}) dragged->follow(pose, task.name, progress);
    }
    return {around.size(), whole.result(), region.result()};
}

} // namespace knead

#include "bench/drag_speed.h"

#include "base/error.h"
#include "base/require.h"
#include "base/stopwatch.h"
#include "bench/posing.h"
#include "cloud/point_cloud.h"
#include "upsample/devices.h"

#include <algorithm>

namespace knead {

namespace {

constexpr double degrees = 60;
constexpr int frames = 30, frames_at_rest = 8;
constexpr double share_of_region = 0.05;

// Drags the document's handle through the task's pose, and takes that back. `rested`: where it came to rest.
DraggedWay drag(const DeformationTask& task, bool coarse, Document& document, LineArray<float>& rested,
                Progress& progress) {
    DraggedWay result;
    std::vector<double> seconds;
    LineArray<float> before;
    const double diagonal = document.bounds().diagonal();
    const auto shape = [&] { return document.pipeline().posed().positions; };
    const Eigen::AngleAxisd whole(task.pose.rotate);
    document.begin_drag("handle", task.pivot, task.name, progress);
    for (int frame = 1; frame <= frames; ++frame) {
        if (frame == frames) before = shape();
        HandlePose pose = turned(degrees * frame / frames, whole.axis());
        pose.coarse = coarse;
        const Stopwatch clock;
        document.drag_frame(pose, task.name, progress);
        (frame == 1 ? result.first_frame : seconds.emplace_back()) = clock.seconds();
    }
    result.frame = summarize(std::move(seconds));
    const LineArray<float> last = shape();
    result.last_step = deviation_between(before, last, diagonal);
    for (int frame = 0; frame < frames_at_rest; ++frame) {
        document.drag_frame(turned(degrees, whole.axis()), task.name, progress);
        if (frame == 0) result.first_at_rest = deviation_between(last, shape(), diagonal);
    }
    rested = shape();
    result.to_rest = deviation_between(last, rested, diagonal);
    document.abandon();
    return result;
}

} // namespace

DragSpeeds measure_drags(const std::string& name, PointCloud cloud, std::span<const std::uint64_t> samples,
                         const Table1Options& options, Progress& progress) {
    require(!samples.empty(), "a number of samples to drag with");
    if (bounds_of(cloud).finite_points == 0)
        throw Error(Trouble::input, name, "holds no point with finite coordinates");
    Workers workers(options.threads);
    UpsamplerChoice choice = make_upsampler(options.device, workers, options.threads);
    DragSpeeds speeds{this_machine(), name, choice.upsampler->device(), cloud.size(), {}, {}, {}};
    if (!choice.warning.empty()) speeds.warnings.push_back(choice.warning);
    const DeformationTask task = bending_task(name, std::move(cloud), degrees);
    for (const std::uint64_t count : samples) {
        if (count >= speeds.points) continue;
        const auto document = open_task(task, with_samples(count), workers, *choice.upsampler);
        DragSpeed row;
        LineArray<float> rested, rested_too;
        row.full = drag(task, false, *document, rested, progress);
        row.coarse = drag(task, true, *document, rested_too, progress);
        row.samples = document->pipeline().samples().size();
        row.upsample = summarize(document->log().upsample).median;
        row.apart = deviation_between(rested, rested_too, document->bounds().diagonal());
        speeds.rows.push_back(row);
    }
    speeds.region =
        measure_region(task, share_of_region, std::ranges::min(samples), options, workers, progress);
    return speeds;
}

} // namespace knead

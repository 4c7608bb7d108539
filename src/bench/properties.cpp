#include "bench/properties.h"

#include "base/workers.h"
#include "bench/automatic_handles.h"
#include "bench/bare_pipeline.h"
#include "bench/posing.h"
#include "edit/document.h"
#include "edit/handle_motion.h"
#include "upsample/devices.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

namespace knead {

namespace {

constexpr unsigned settle_iterations = 300;

// The rigid motion that all handles make, about the middle of the cloud.
HandlePose rigid_pose(double diagonal) {
    HandlePose pose;
    pose.rotate = Eigen::AngleAxisd(0.7, Vec3d(1, 2, 3).normalized());
    pose.translate = diagonal * Vec3d(0.2, -0.1, 0.15);
    return pose;
}

// Of each ordered point: whether its part of the cloud holds a handle.
std::vector<bool> held_points(const Pipeline& pipeline) {
    const std::vector<bool> held = held_parts(pipeline);
    std::vector<bool> result;
    const Numbering& vertex = pipeline.order().vertex;
    for (std::size_t i = 0; i < vertex.size(); ++i)
        result.push_back(held[pipeline.components().component[vertex[i]]]);
    return result;
}

// How far points in the order of the pipeline are from where the motion sends them.
double deviation_from(const HandleMotion& motion, const Pipeline& pipeline, std::span<const float> posed,
                      double diagonal) {
    const std::vector<bool> held = held_points(pipeline);
    double largest = 0;
    for (std::size_t i = 0; i < held.size(); ++i) {
        if (!held[i]) continue;
        const Vec3d target = moved_point(motion, point_at(pipeline.opened().positions, i));
        largest = std::max(largest, (point_at(posed, i) - target).norm());
    }
    return diagonal > 0 ? largest / diagonal : largest;
}

std::vector<float> in_pipeline_order(const Pipeline& pipeline, const std::vector<float>& file_order) {
    std::vector<float> result;
    for (const Index i : pipeline.order().file_index)
        result.insert(result.end(), file_order.begin() + 3 * std::ptrdiff_t{i},
                      file_order.begin() + 3 * std::ptrdiff_t{i} + 3);
    return result;
}

// The two automatic handles on a document; the lower one may move too.
void declare_handles(Document& document, const AutomaticHandles& handles, HandleRole lower) {
    document.declare(handle_line("lower", lower, handles.fixed), "");
    document.declare(handle_line("upper", HandleRole::moving, handles.moving), "");
}

bool same_bytes(const std::vector<float>& a, const std::vector<float>& b) {
    return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(float)) == 0;
}

void check_rigid_frame(const PointCloud& cloud, const AutomaticHandles& automatic, const HandlePose& pose,
                       Workers& workers, Upsampler& upsampler, Progress& progress, CloudProperties& result) {
    Pipeline pipeline(cloud, workers, upsampler);
    PipelineInput input;
    input.handles = {{"lower", HandleRole::moving, shared_points(automatic.fixed)},
                     {"upper", HandleRole::moving, shared_points(automatic.moving)}};
    pipeline.prepare(input, progress);
    const HandleMotion motion = motion_of(pose, automatic.pivot, cloud.origin, {});
    pose_from_rest(pipeline, std::vector<HandleMotion>(2, motion), input.settings.iterations);
    result.strays = pipeline.strays().points;
    result.rigid = deviation_from(motion, pipeline, pipeline.posed().positions, bounds_of(cloud).diagonal());
}

// With handles that stay nothing moves; with handles that go one after the other all come to the same place.
void check_document(const PointCloud& cloud, const AutomaticHandles& automatic, const HandlePose& pose,
                    Workers& workers, Upsampler& upsampler, Progress& progress, CloudProperties& result) {
    Document document(cloud, Settings{}, workers, upsampler);
    declare_handles(document, automatic, HandleRole::moving);

    document.drag({"upper", automatic.pivot, {HandlePose{}}}, "", progress);
    document.settle({10}, progress);
    const std::vector<float> still = document.positions(progress);
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (std::memcmp(&still[3 * i], &cloud.positions[3 * i], 3 * sizeof(float)) != 0)
            ++result.moved_by_nothing;
    document.undo("");
    document.undo("");

    const std::size_t before = document.log().iteration.size();
    document.drag({"lower", automatic.pivot, {pose}}, "", progress);
    document.drag({"upper", automatic.pivot, {pose}}, "", progress);
    document.settle({settle_iterations}, progress);
    result.iterations_in_turns = document.log().iteration.size() - before;
    const HandleMotion motion = motion_of(pose, automatic.pivot, cloud.origin, {});
    const Pipeline& pipeline = document.pipeline();
    result.rigid_in_turns =
        deviation_from(motion, pipeline, in_pipeline_order(pipeline, document.positions(progress)),
                       document.bounds().diagonal());
}

// The twist along the long bar, and how uneven it is, both in degrees.
void measure_twist(const PointCloud& cloud, const std::vector<float>& posed, double asked, double& total,
                   double& uneven) {
    constexpr std::size_t slices = 100;
    const std::vector<double> turns = turns_along_z(cloud.positions, posed, slices);
    total = turns.back() - turns.front();
    uneven = 0;
    for (std::size_t s = 0; s < slices; ++s) {
        const double z = long_bar_half * (2 * (static_cast<double>(s) + 0.5) / slices - 1);
        const double even = asked * std::clamp((z + long_bar_free) / (2 * long_bar_free), 0.0, 1.0);
        uneven = std::max(uneven, std::abs(turns[s] - turns.front() - even));
    }
}

// A bend in three frames, from opening the cloud to the last byte.
std::vector<float> bend(const PointCloud& cloud, const AutomaticHandles& automatic, const std::string& device,
                        unsigned threads, Progress& progress, double& handle_error) {
    Workers workers(threads);
    const UpsamplerChoice choice = make_upsampler(device, workers, threads);
    Document document(cloud, Settings{}, workers, *choice.upsampler);
    declare_handles(document, automatic, HandleRole::fixed);
    DragLine line{"upper", automatic.pivot, {}};
    for (const double degrees : {10.0, 20.0, 30.0}) line.frames.push_back(bent_by(automatic, degrees));
    document.drag(line, "", progress);
    handle_error = document.handle_error(progress);
    return document.positions(progress);
}

} // namespace

CloudProperties evaluate_cloud(const std::string& name, const PointCloud& cloud, const std::string& device,
                               unsigned threads, Progress& progress) {
    CloudProperties result;
    result.name = name;
    result.points = cloud.size();
    const AutomaticHandles automatic = automatic_handles(cloud);
    const HandlePose pose = rigid_pose(bounds_of(cloud).diagonal());
    {
        Workers workers(threads);
        const UpsamplerChoice choice = make_upsampler(device, workers, threads);
        check_rigid_frame(cloud, automatic, pose, workers, *choice.upsampler, progress, result);
        check_document(cloud, automatic, pose, workers, *choice.upsampler, progress, result);
    }
    const auto bent = [&](unsigned on_threads) {
        return bend(cloud, automatic, device, on_threads, progress, result.handle_error);
    };
    const std::vector<float> once = bent(threads);
    result.same_again = same_bytes(once, bent(threads));
    result.same_for_threads = same_bytes(once, bent(1)) && same_bytes(once, bent(2));
    return result;
}

TwistResult evaluate_twist(Workers& workers, Upsampler& upsampler, Progress& progress) {
    constexpr double step = 10;
    constexpr int steps = 72;
    const DeformationTask task = generated_task("made-long-bar", workers, progress);
    const PointCloud& cloud = task.cloud;
    const auto opened = open_task(task, Settings{}, workers, upsampler);
    Document& document = *opened;
    DragLine line{"handle", task.pivot, {}};
    for (int s = 1; s <= steps; ++s) line.frames.push_back(turned(step * s, Vec3d::UnitZ()));

    TwistResult result;
    result.points = cloud.size();
    result.asked = step * steps;
    document.drag(line, "", progress);
    measure_twist(cloud, document.positions(progress), result.asked, result.measured, result.uneven);
    document.settle({100}, progress);
    measure_twist(cloud, document.positions(progress), result.asked, result.settled, result.settled_uneven);
    return result;
}

std::vector<double> turns_along_z(std::span<const float> rest, std::span<const float> posed,
                                  std::size_t slices) {
    double lowest = rest[2];
    double highest = rest[2];
    for (std::size_t i = 2; i < rest.size(); i += 3) {
        lowest = std::min(lowest, double{rest[i]});
        highest = std::max(highest, double{rest[i]});
    }
    std::vector<double> sines(slices), cosines(slices);
    for (std::size_t i = 0; i < rest.size() / 3; ++i) {
        const Vec3d from = point_at(rest, i);
        const Vec3d to = point_at(posed, i);
        const double place = (from.z() - lowest) / std::max(highest - lowest, 1e-300);
        const std::size_t slice =
            std::min(slices - 1, static_cast<std::size_t>(place * static_cast<double>(slices)));
        sines[slice] += from.x() * to.y() - from.y() * to.x();
        cosines[slice] += from.x() * to.x() + from.y() * to.y();
    }
    std::vector<double> turns;
    for (std::size_t s = 0; s < slices; ++s) {
        const bool empty = sines[s] == 0 && cosines[s] == 0;
        const double before = turns.empty() ? 0 : turns.back();
        const double turn = std::atan2(sines[s], cosines[s]) * 180 / std::numbers::pi;
        turns.push_back(empty ? before : turn + 360 * std::round((before - turn) / 360));
    }
    return turns;
}

} // namespace knead

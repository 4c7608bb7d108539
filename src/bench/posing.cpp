#include "bench/posing.h"

#include "bench/automatic_handles.h"

#include <numbers>

namespace knead {

std::unique_ptr<Document> open_task(const DeformationTask& task, const Settings& settings, Workers& workers,
                                    Upsampler& upsampler) {
    auto document = std::make_unique<Document>(task.cloud, settings, workers, upsampler);
    document->declare(handle_line("fixed", HandleRole::fixed, task.fixed), task.name);
    document->declare(handle_line("handle", HandleRole::moving, task.handle), task.name);
    return document;
}

Settings with_samples(const std::optional<std::uint64_t>& samples) {
    Settings settings;
    settings.samples = samples;
    return settings;
}

HandlePose shifted(const Vec3d& way) {
    HandlePose pose;
    pose.translate = way;
    return pose;
}

HandlePose turned(double degrees, const Vec3d& axis) {
    HandlePose pose;
    pose.rotate = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis);
    return pose;
}

DragLine whole_motion(const DeformationTask& task) {
    return {"handle", task.pivot, {task.pose}};
}

Settling settle(Document& document, unsigned limit, Progress& progress) {
    const std::size_t before = document.log().iteration.size();
    document.settle({limit}, progress);
    const std::size_t now = document.log().iteration.size();
    return {now, now < before + limit};
}

DeformationTask bending_task(const std::string& name, PointCloud cloud, double degrees) {
    AutomaticHandles handles = automatic_handles(cloud);
    DeformationTask task;
    task.name = name;
    task.pose = bent_by(handles, degrees);
    task.pivot = handles.pivot;
    task.fixed = std::move(handles.fixed);
    task.handle = std::move(handles.moving);
    task.cloud = std::move(cloud);
    return task;
}

} // namespace knead

// Likenesses of the survey's shapes, from knead's own generator.

#include "base/require.h"
#include "bench/survey.h"
#include "shapes/shapes.h"

#include <algorithm>
#include <functional>
#include <numbers>

namespace knead {

namespace {

Quatd turn(double degrees, const Vec3d& axis) {
    return Quatd(Eigen::AngleAxisd(degrees * std::numbers::pi / 180, axis));
}

void hold(DeformationTask& task, const std::function<bool(const Vec3d&)>& is_fixed,
          const std::function<bool(const Vec3d&)>& is_handle) {
    for (Index i = 0; i < task.cloud.size(); ++i) {
        const Vec3d place = task.cloud.file_position(i);
        if (is_fixed(place)) task.fixed.push_back(i);
        if (is_handle(place)) task.handle.push_back(i);
    }
}

// Bar and cylinder: five long around z, held by a tenth at either end.
void hold_ends(DeformationTask& task) {
    hold(
        task, [](const Vec3d& p) { return p.z() <= -2; }, [](const Vec3d& p) { return p.z() >= 2; });
}

// A made bar, twice as long.
PointCloud long_bar(const ShapeOptions& sampling, Workers& workers, Progress& progress) {
    const PointCloud bar = make_shape(Shape::bar, sampling, workers, progress);
    std::vector<float> positions = bar.positions;
    for (std::size_t i = 0; i < bar.size(); ++i) {
        const Vec3f place = bar.file_position(i).cwiseProduct(Vec3d(1, 1, 2)).cast<float>();
        std::ranges::copy(place, positions.begin() + static_cast<std::ptrdiff_t>(3 * i));
    }
    return make_cloud(positions);
}

// The free part, 4 long, becomes an arc of its own length: the upper end is slid down onto the lower one and
// turned around the arc's centre.
void bend(DeformationTask& task, double degrees) {
    constexpr double free_length = 4;
    const double radius = free_length / (degrees * std::numbers::pi / 180);
    task.pivot = {radius, 0, -free_length / 2};
    task.pose.rotate = turn(degrees, Vec3d::UnitY());
    task.pose.translate = task.pose.rotate * Vec3d(0, 0, -free_length);
}

} // namespace

std::vector<std::string> generated_names() {
    return {"made-bar", "made-cylinder", "made-plane"};
}

DeformationTask generated_task(std::string_view name, Workers& workers, Progress& progress) {
    ShapeOptions sampling;
    sampling.points = name == "made-bar"        ? 6000
                      : name == "made-cylinder" ? 5000
                      : name == "made-long-bar" ? 20'000
                                                : 10'000;
    return generated_task(name, sampling, workers, progress);
}

DeformationTask generated_task(std::string_view name, const ShapeOptions& sampling, Workers& workers,
                               Progress& progress) {
    DeformationTask task;
    task.name = name;
    if (name == "made-bar") {
        task.cloud = make_shape(Shape::bar, sampling, workers, progress);
        hold_ends(task);
        task.pose.rotate = turn(135, Vec3d::UnitZ());
    } else if (name == "made-long-bar") {
        task.cloud = long_bar(sampling, workers, progress);
        hold(
            task, [](const Vec3d& p) { return p.z() <= -long_bar_free; },
            [](const Vec3d& p) { return p.z() >= long_bar_free; });
        task.pose.rotate = turn(180, Vec3d::UnitZ());
    } else if (name == "made-cylinder" || name == "made-solid-bar") {
        const Shape shape = name == "made-cylinder" ? Shape::cylinder : Shape::solid_bar;
        task.cloud = make_shape(shape, sampling, workers, progress);
        hold_ends(task);
        bend(task, 120);
    } else {
        require(name == "made-plane", "the name of a generated task");
        task.cloud = make_shape(Shape::plane, sampling, workers, progress);
        hold(
            task, [](const Vec3d& p) { return p.x() <= 0.1; }, [](const Vec3d& p) { return p.x() >= 0.9; });
        task.pose.translate = {-0.3, 0, 0.55};
    }
    return task;
}

} // namespace knead

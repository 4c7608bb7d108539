// Figure 2 of the paper: neighbours through the air, and along the surface.

#include "bench/air_neighbors.h"
#include "bench/bare_pipeline.h"
#include "bench/deviation.h"
#include "bench/made_cloud.h"
#include "bench/page_studio.h"
#include "bench/posing.h"
#include "bench/text_table.h"
#include "edit/handle_motion.h"

#include <functional>
#include <numbers>

namespace knead {

namespace {

constexpr std::uint64_t samples = 100;
constexpr unsigned iterations = 100;

// What stays and what is moved, and how, on a cloud where parts come close.
struct Close {
    std::string name, words; // "dragon", "the tail is bent away"
    std::function<bool(const Vec3d&)> is_fixed, is_handle;
    Vec3d pivot = Vec3d::Zero();
    HandlePose pose;
    PageView view;
    double seen = 0; // the picture shows what lies so far around the handle; 0: the whole cloud
};

// What of the cloud the camera is to have in view, at rest and posed.
std::vector<float> seen_part(const Close& close, const PageShape& shape, const DeformationTask& task) {
    Vec3d middle = Vec3d::Zero();
    for (const Index i : task.handle)
        middle += point_at(task.cloud.positions, i) / static_cast<double>(task.handle.size());
    std::vector<float> part;
    for (const std::span<const float> positions : {shape.opened, shape.positions})
        for (std::size_t i = 0; i < positions.size() / 3; ++i) {
            if (close.seen > 0 && (point_at(shape.opened, i) - middle).norm() > close.seen) continue;
            part.insert(part.end(), positions.begin() + 3 * static_cast<std::ptrdiff_t>(i),
                        positions.begin() + 3 * static_cast<std::ptrdiff_t>(i) + 3);
        }
    return part;
}

DeformationTask task_of(const Close& close, PointCloud cloud) {
    DeformationTask task;
    task.name = close.name;
    task.cloud = std::move(cloud);
    task.pivot = close.pivot;
    task.pose = close.pose;
    for (Index i = 0; i < task.cloud.size(); ++i) {
        const Vec3d place = task.cloud.file_position(i);
        if (close.is_fixed(place)) task.fixed.push_back(i);
        if (close.is_handle(place)) task.handle.push_back(i);
    }
    return task;
}

// One strand of the knot's crossing at 60°, lifted off the other; the crossings at 180° and 300° stay.
Close close_knot() {
    const Vec3d upper = knot_spine(std::numbers::pi / 6);
    const auto at_other_crossing = [](const Vec3d& p) {
        const Vec3d flat(p.x(), p.y(), 0);
        return (flat - Vec3d(-2, 0, 0)).norm() < 0.8 || (flat - Vec3d(1, -std::sqrt(3.0), 0)).norm() < 0.8;
    };
    return {"knot",
            "the upper strand is lifted off the lower one",
            at_other_crossing,
            [upper](const Vec3d& p) { return p.z() > 0 && (p - upper).norm() < 0.7; },
            Vec3d::Zero(),
            shifted({0, 0, 1.2}),
            {20, 25, UpAxis::z, usual_size, {}}};
}

Close close_bunny() {
    return {"bunny",
            "one ear is raised, the other is not touched",
            [](const Vec3d& p) { return p.y() < 0.1; },
            [](const Vec3d& p) { return (p - Vec3d(-0.07, 0.172, -0.05)).norm() < 0.018; },
            Vec3d(-0.065, 0.148, -0.012),
            turned(90, Vec3d::UnitX()),
            {-20, 15, UpAxis::y, usual_size, {}},
            0.08};
}

Close close_armadillo() {
    return {"armadillo",
            "the arm beside an ear is taken down, the ear is not touched",
            [](const Vec3d& p) { return p.y() < 20; },
            [](const Vec3d& p) { return p.x() > 42 && p.y() > 35; },
            Vec3d(25, 58, -5),
            turned(-80, Vec3d::UnitZ()),
            {20, 5, UpAxis::y, usual_size, {}},
            65};
}

Close close_dragon() {
    return {"dragon",
            "the lower jaw is opened",
            [](const Vec3d& p) { return p.y() < 0.12 || p.x() > -0.04; },
            [](const Vec3d& p) { return p.x() < -0.09 && p.y() < 0.16; },
            Vec3d(-0.06, 0.15, 0),
            turned(30, Vec3d::UnitZ()),
            {15, 10, UpAxis::y, usual_size, {}},
            0.08};
}

PageScene scene_of(const Close& close, const DeformationTask& task, const std::filesystem::path& cloud_file) {
    PageScene scene;
    scene.name = close.name + "-neighbors";
    scene.cloud_name = close.name;
    scene.cloud = task.cloud;
    scene.cloud_file = cloud_file;
    scene.settings.samples = samples;
    scene.settings.iterations = iterations;
    scene.acts = acts_of(task);
    scene.acts.pop_back(); // the settling: the iterations are enough
    scene.view = close.view;
    scene.rest_is_shown = true;
    return scene;
}

// Poses the points, and says by which motions of the handles; returns the samples.
SampleState pose(Pipeline& pipeline, const DeformationTask& task, const Settings& settings,
                 std::vector<HandleMotion>& motions, Progress& progress) {
    pipeline.prepare({settings,
                      {{"fixed", HandleRole::fixed, shared_points(task.fixed)},
                       {"handle", HandleRole::moving, shared_points(task.handle)}},
                      nullptr},
                     progress);
    motions = {HandleMotion{}, motion_of(task.pose, task.pivot, task.cloud.origin, {})};
    return pose_from_rest(pipeline, motions, iterations);
}

PageRow row_of(PageStudio& studio, const Close& close, PointCloud cloud,
               const std::filesystem::path& cloud_file) {
    const DeformationTask task = task_of(close, std::move(cloud));
    PageScene scene = scene_of(close, task, cloud_file);
    write_session(studio, scene);
    Pipeline pipeline(scene.cloud, studio.workers, studio.upsampler);
    std::vector<HandleMotion> motions;
    const SampleState state = pose(pipeline, task, scene.settings, motions, studio.progress);

    PageShape shape{&pipeline.order(),
                    &pipeline.graph(),
                    pipeline.opened().positions,
                    pipeline.posed().positions,
                    holders_of_points(pipeline),
                    {},
                    1,
                    false};
    scene.view.framed = seen_part(close, shape, task);
    PageRow row{close.name + ": " + close.words, {}};
    PagePicture along = draw_scene(studio, scene, "geodesic", shape);
    along.caption = "The eight nearest along the surface.";
    along.command = replay_command(scene, "", along);
    const std::vector<float> through = posed_through_the_air(pipeline, motions, state, studio.workers);
    const std::span<const float> surface = shape.positions;
    shape.positions = through;
    PagePicture air = draw_scene(studio, scene, "euclidean", shape);
    const Deviation apart = deviation_between(through, surface, bounds_of(scene.cloud).diagonal());
    air.caption =
        "The eight nearest through the air (made for this page, no setting of knead's does it): up to " +
        digits_text(100 * apart.largest, 1) + " % of D from the third picture.";
    shape.positions = shape.opened;
    PagePicture rest = draw_scene(studio, scene, "rest", shape);
    rest.caption = "At rest.";
    row.pictures = {rest, air, along};
    return row;
}

} // namespace

PageSection neighbors_section(PageStudio& studio) {
    PageSection section{
        "Figure 2: neighbours along the surface",
        "What influences a point is told along the surface, so that parts that come close do not "
        "move each other. With 100 samples; only which samples move a point differs between the "
        "second and the third picture of a row.",
        {},
        {}};
    section.rows.push_back(
        row_of(studio, close_knot(), made_cloud(Shape::knot, 40'000, studio.workers, studio.progress), {}));
    const Close closes[] = {close_bunny(), close_armadillo(), close_dragon()};
    add_scan_rows(studio, section, [&](const std::string& name, PointCloud cloud, const auto& file) {
        return row_of(studio, *std::ranges::find(closes, name, &Close::name), std::move(cloud), file);
    });
    return section;
}

} // namespace knead

// Figure 1 of the paper: a creature posed by a few handles, and its likenesses.

#include "bench/made_cloud.h"
#include "bench/page_studio.h"
#include "bench/scan_samples.h"
#include "io/cloud_file.h"

#include <numbers>

namespace knead {

namespace {

// A handle that turns about an axis through a pivot; a part that hangs on another goes with it.
struct Joint {
    std::string name;
    Region region;
    Vec3d pivot, axis;
    double degrees = 0;
    std::string hangs_on; // the name of a joint before; empty: none
};

struct Pose {
    std::string name, words;
    Region fixed;
    std::vector<Joint> joints;
    PageView view;
};

constexpr int frames = 9;

Quatd turn_of(const Joint& joint, double part) {
    return Quatd(Eigen::AngleAxisd(part * joint.degrees * std::numbers::pi / 180, joint.axis));
}

HandlePose pose_of(const Joint& joint, const Joint* under, double part) {
    HandlePose pose;
    pose.rotate = turn_of(joint, part);
    if (under) { // first its own turn, then that of what it hangs on
        const Quatd carried = turn_of(*under, part);
        pose.rotate = carried * pose.rotate;
        pose.translate = under->pivot + carried * (joint.pivot - under->pivot) - joint.pivot;
    }
    return pose;
}

std::vector<SessionAction> acts_of(const Pose& pose) {
    std::vector<SessionAction> acts;
    HandleLine fixed;
    fixed.name = "fixed";
    fixed.role = HandleRole::fixed;
    fixed.points = pose.fixed;
    acts.emplace_back(fixed);
    for (const Joint& joint : pose.joints) {
        HandleLine line;
        line.name = joint.name;
        line.points = joint.region;
        acts.emplace_back(line);
    }
    for (const Joint& joint : pose.joints) {
        const auto under = std::ranges::find(pose.joints, joint.hangs_on, &Joint::name);
        DragLine drag{joint.name, joint.pivot, {}};
        for (int f = 1; f <= frames; ++f)
            drag.frames.push_back(
                pose_of(joint, under == pose.joints.end() ? nullptr : &*under, double{1} * f / frames));
        acts.emplace_back(drag);
    }
    acts.emplace_back(SettleLine{300});
    return acts;
}

PageRow row_of(PageStudio& studio, const Pose& pose, PointCloud cloud,
               const std::filesystem::path& cloud_file) {
    PageScene scene;
    scene.name = pose.name + "-posed";
    scene.cloud_name = pose.name;
    scene.cloud = std::move(cloud);
    scene.cloud_file = cloud_file;
    scene.acts = acts_of(pose);
    scene.view = pose.view;
    scene.rest_is_shown = true;
    write_session(studio, scene);
    const auto document = carry_out(studio, scene, scene.settings);
    PageShape shape = shape_of(studio, *document);
    PageRow row{pose.name, {}};
    PagePicture after = draw_scene(studio, scene, "after", shape);
    after.caption = pose.words;
    after.command = replay_command(scene, "", after);
    shape.positions = shape.opened;
    PagePicture before = draw_scene(studio, scene, "before", shape);
    before.caption = "At rest: what stays is blue, the handles have a colour each.";
    before.command = "knead render " + (cloud_file.empty() ? pose.name + ".ply" : cloud_file.string()) + " " +
                     view_option(pose.view) + " --out " + before.file;
    row.pictures = {before, after};
    return row;
}

Pose creature_pose() {
    return {"creature",
            "Head twisted 45°, one arm 90°, the other bent 30°; the feet stay. 1000 samples. The loose "
            "points are the strays "
            "of the virtual scan.",
            HalfspaceRegion{Vec3d(0, 0, 0.33), Vec3d(0, 0, -1)},
            {{"head", BoxRegion{Vec3d(-0.4, -0.5, 1.2), Vec3d(0.6, 0.5, 1.85)}, Vec3d(0.03, 0, 1.2),
              Vec3d::UnitZ(), 45, ""},
             {"left arm", BoxRegion{Vec3d(-0.3, 0.62, 0.7), Vec3d(0.4, 1.3, 1.3)}, Vec3d(0, 0.25, 0.95),
              Vec3d::UnitZ(), -90, ""},
             {"right arm", BoxRegion{Vec3d(-0.3, -1.3, 0.7), Vec3d(0.4, -0.62, 1.3)}, Vec3d(0, -0.25, 0.95),
              Vec3d::UnitX(), 30, ""}},
            {60, 15, UpAxis::z, usual_size, {}}};
}

Pose armadillo_pose() {
    return {
        "armadillo",
        "Head twisted 45°, one arm turned down by 90°, the other bent 30°; the shins stay. 1000 samples.",
        HalfspaceRegion{Vec3d(0, -20, 0), Vec3d(0, -1, 0)},
        {{"head", BoxRegion{Vec3d(-24, 56, 8), Vec3d(24, 100, 60)}, Vec3d(0, 56, 12), Vec3d::UnitY(), 45, ""},
         {"right arm", BoxRegion{Vec3d(-70, 35, -30), Vec3d(-42, 100, 60)}, Vec3d(-25, 58, -5),
          Vec3d::UnitZ(), 90, ""},
         {"left arm", BoxRegion{Vec3d(42, 35, -30), Vec3d(70, 100, 60)}, Vec3d(25, 58, -5), Vec3d::UnitZ(),
          -30, ""}},
        {20, 5, UpAxis::y, usual_size, {}}};
}

Pose bunny_pose() {
    return {"bunny",
            "It has no arms: head twisted 45°, one ear laid over by 90°, the other bent 30°; the base stays. "
            "1000 samples.",
            HalfspaceRegion{Vec3d(0, 0.06, 0), Vec3d(0, -1, 0)},
            {{"face", BoxRegion{Vec3d(-0.1, 0.112, -0.01), Vec3d(-0.055, 0.14, 0.06)},
              Vec3d(-0.06, 0.11, 0.015), Vec3d::UnitY(), 45, ""},
             {"right ear", SphereRegion{Vec3d(-0.07, 0.172, -0.05), 0.018}, Vec3d(-0.065, 0.148, -0.012),
              Vec3d::UnitZ(), 90, "face"},
             {"left ear", SphereRegion{Vec3d(-0.018, 0.178, -0.015), 0.018}, Vec3d(-0.045, 0.15, 0.0),
              Vec3d::UnitZ(), 30, "face"}},
            {-20, 15, UpAxis::y, usual_size, {}}};
}

Pose dragon_pose() {
    return {"dragon",
            "It has no free arms: head twisted 45°, tail bent 90°; the ground stays. 1000 samples.",
            HalfspaceRegion{Vec3d(0, 0.075, 0), Vec3d(0, -1, 0)},
            {{"head", BoxRegion{Vec3d(-0.12, 0.142, -0.06), Vec3d(-0.03, 0.21, 0.04)},
              Vec3d(-0.05, 0.14, -0.005), Vec3d::UnitY(), 45, ""},
             {"tail", BoxRegion{Vec3d(0.078, 0.122, -0.04), Vec3d(0.11, 0.16, 0.01)}, Vec3d(0.075, 0.1, 0),
              Vec3d::UnitZ(), -90, ""}},
            {15, 10, UpAxis::y, usual_size, {}}};
}

} // namespace

PageSection posed_section(PageStudio& studio) {
    PageSection section{"Figure 1: a creature, posed",
                        "A few handles, dragged in nine frames each and settled; all between them follows.",
                        {},
                        {}};
    section.rows.push_back(row_of(studio, creature_pose(),
                                  made_cloud(Shape::creature, 50'000, studio.workers, studio.progress), {}));
    const Pose poses[] = {bunny_pose(), armadillo_pose(), dragon_pose()};
    for (const ScanOfThePaper& scan : scans_of_the_paper()) {
        const auto pose = std::ranges::find(poses, std::string(scan.name), &Pose::name);
        if (const auto path = find_data_file(studio.scans, scan.file))
            section.rows.push_back(row_of(studio, *pose, read_cloud(*path, studio.progress), *path));
        else
            section.missing.push_back(missing_words(studio.scans, scan.file) + ", so it is not posed here.");
    }
    return section;
}

PageSection unknown_section() {
    return {"Figures 3 and 5",
            "",
            {},
            {"what Figures 3 and 5 of the paper show is written nowhere in this project, so neither they nor "
             "their likenesses are here."}};
}

} // namespace knead

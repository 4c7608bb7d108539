#include "bench/page_joints.h"

#include "base/counts.h"
#include "bench/text_table.h"

#include <algorithm>
#include <numbers>

namespace knead {

namespace {

Quatd turn_of(const Joint& joint, double part) {
    return Quatd(Eigen::AngleAxisd(part * joint.degrees * std::numbers::pi / 180, joint.axis));
}

// The way of a handle whose free part becomes an arc: it slides back to the pivot and turns about the arc's
// middle.
Vec3d arc_of(const Joint& joint, double part) {
    const double length = joint.free_part.norm();
    if (!(length > 0)) return Vec3d::Zero();
    const double angle = part * joint.degrees * std::numbers::pi / 180;
    const Vec3d middle = length / angle * joint.axis.cross(joint.free_part / length);
    return middle - turn_of(joint, part) * (joint.free_part + middle);
}

HandlePose pose_of(const Joint& joint, const Joint* under, double part) {
    HandlePose pose;
    pose.rotate = turn_of(joint, part);
    pose.translate = arc_of(joint, part);
    if (under) { // first its own turn, then that of what it hangs on
        const Quatd carried = turn_of(*under, part);
        pose.rotate = carried * pose.rotate;
        pose.translate = under->pivot + carried * (joint.pivot + pose.translate - under->pivot) - joint.pivot;
    }
    return pose;
}

} // namespace

std::vector<SessionAction> acts_of(const JointedPose& pose) {
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
        for (int f = 1; f <= pose.frames; ++f)
            drag.frames.push_back(
                pose_of(joint, under == pose.joints.end() ? nullptr : &*under, double{1} * f / pose.frames));
        acts.emplace_back(drag);
    }
    acts.emplace_back(SettleLine{300});
    return acts;
}

PageRow jointed_row(PageStudio& studio, const JointedPose& pose, const std::string& suffix, PointCloud cloud,
                    const std::filesystem::path& cloud_file, bool plain_first) {
    PageScene scene;
    scene.name = pose.name + "-" + suffix;
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
    if (plain_first) {
        shape.handle = {};
        PagePicture plain = draw_scene(studio, scene, "plain", shape);
        plain.caption = grouped(scene.cloud.size()) + " points.";
        row.pictures.push_back(plain);
    }
    row.pictures.push_back(before);
    row.pictures.push_back(after);
    return row;
}

void add_posed_scans(PageStudio& studio, std::span<const JointedPose> poses, const std::string& suffix,
                     bool plain_first, PageSection& section) {
    add_scan_rows(studio, section, [&](const std::string& name, PointCloud cloud, const auto& file) {
        return jointed_row(studio, *std::ranges::find(poses, name, &JointedPose::name), suffix,
                           std::move(cloud), file, plain_first);
    });
}

} // namespace knead

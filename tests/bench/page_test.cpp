// The evaluation's page: its text, its scenes, and what only it computes.

#include "bench/air_neighbors.h"
#include "bench/automatic_handles.h"
#include "bench/bare_pipeline.h"
#include "bench/deviation.h"
#include "bench/made_cloud.h"
#include "bench/page_joints.h"
#include "bench/posing.h"

#include "base/error.h"
#include "edit/handle_motion.h"
#include "shapes/shapes.h"
#include "support/scratch_folder.h"
#include "upsample/devices.h"

#include <gtest/gtest.h>

#include <fstream>
#include <numbers>
#include <sstream>

namespace {

using namespace knead;
namespace fs = std::filesystem;

TEST(PageHtml, SaysEverythingAndEscapesIt) {
    const PageSection section{
        "A & B", "x < y", {{"row", {{"a.png", "seen \"so\"", "knead <x>"}}}}, {"a scan"}};
    const std::string html = page_html("title", "words", {&section, 1});
    for (const char* text : {"A &amp; B", "x &lt; y", "src=\"a.png\"", "seen &quot;so&quot;",
                             "knead &lt;x&gt;", "Missing: a scan", "<h1>title</h1>", "charset=\"utf-8\""})
        EXPECT_NE(html.find(text), std::string::npos) << text;
    EXPECT_EQ(html.find("<script"), std::string::npos);
}

TEST(PageHtml, ShowsAScaleWhereThereIsOne) {
    PageSection section{"A", "b", {}, {}, "none < some", "all"};
    const std::string html = page_html("title", "words", {&section, 1});
    EXPECT_NE(html.find("none &lt; some <span style=\"background: linear-gradient(to right, rgb(68,1,84)"),
              std::string::npos)
        << html;
    section.scale_low = section.scale_high = {};
    EXPECT_EQ(page_html("title", "words", {&section, 1}).find("gradient"), std::string::npos);
}

// The far end of a strip of length π that is rolled by half a turn lies a diameter of 2 above its near one.
TEST(PageJoints, RollUpWithoutStretching) {
    Joint joint{"edge", WholeRegion{}, Vec3d(1, 2, 3), -Vec3d::UnitY(), 180, ""};
    joint.free_part = Vec3d(std::numbers::pi, 0, 0);
    JointedPose pose{"strip", "", WholeRegion{}, {joint}, {}, 10};
    const std::vector<SessionAction> acts = acts_of(pose);
    const auto& frames = std::get<DragLine>(acts[2]).frames;
    ASSERT_EQ(frames.size(), 10U);
    const auto end_at = [&](const HandlePose& frame) {
        return Vec3d(joint.pivot + frame.rotate * joint.free_part + frame.translate);
    };
    EXPECT_LT((end_at(frames[9]) - (joint.pivot + Vec3d(0, 0, 2))).norm(), 1e-12);
    EXPECT_LT((end_at(frames[4]) - (joint.pivot + Vec3d(2, 0, 2))).norm(), 1e-12); // a quarter of radius 2
}

// How far apart, over D, points end by the samples near them along the surface and by those near in the air.
Deviation through_the_air(const PointCloud& cloud, std::vector<Index> fixed, std::vector<Index> moving,
                          const HandleMotion& motion) {
    Workers workers(2);
    SilentProgress progress;
    const auto upsampler = make_reference_upsampler(workers);
    Pipeline pipeline(cloud, workers, *upsampler);
    pipeline.prepare({with_samples(200),
                      {{"fixed", HandleRole::fixed, shared_points(std::move(fixed))},
                       {"handle", HandleRole::moving, shared_points(std::move(moving))}},
                      nullptr},
                     progress);
    const std::vector<HandleMotion> motions{{}, motion};
    const SampleState state = pose_from_rest(pipeline, motions, 30);
    return deviation_between(posed_through_the_air(pipeline, motions, state, workers),
                             pipeline.posed().positions, bounds_of(cloud).diagonal());
}

PointCloud made(Shape shape) {
    Workers workers(2);
    SilentProgress progress;
    return made_cloud(shape, 3000, workers, progress);
}

TEST(AirNeighbors, AgreeWhereAShapeComesNearItselfNowhere) {
    const PointCloud cloud = made(Shape::bar);
    const AutomaticHandles ends = automatic_handles(cloud);
    EXPECT_EQ(through_the_air(cloud, ends.fixed, ends.moving, {}).largest, 0);
    const HandleMotion bent = motion_of(bent_by(ends, 30), ends.pivot, cloud.origin, {});
    const Deviation apart = through_the_air(cloud, ends.fixed, ends.moving, bent);
    EXPECT_LT(apart.largest, 0.02);
    EXPECT_GT(apart.largest, 0) << "their distances are others";
}

// Figure 2 of the paper: the upper strand of a crossing is lifted, and takes some of the lower one along.
TEST(AirNeighbors, TearWhatLiesCloseAndIsFarAlongTheSurface) {
    const PointCloud cloud = made(Shape::knot);
    const Vec3d upper = knot_spine(std::numbers::pi / 6);
    std::vector<Index> fixed, lifted;
    for (Index i = 0; i < cloud.size(); ++i) {
        const Vec3d p = cloud.file_position(i);
        if (p.x() < -1.5) fixed.push_back(i);
        if (p.z() > 0 && (p - upper).norm() < 0.7) lifted.push_back(i);
    }
    EXPECT_EQ(through_the_air(cloud, fixed, lifted, {}).largest, 0);
    const HandleMotion up = motion_of(shifted({0, 0, 1.2}), Vec3d::Zero(), cloud.origin, {});
    EXPECT_GT(through_the_air(cloud, fixed, lifted, up).largest, 0.05);
}

TEST(PageScenes, LeaveASessionThatReplays) {
    Workers workers(2);
    SilentProgress progress;
    const auto upsampler = make_reference_upsampler(workers);
    std::unique_ptr<PageDrawer> drawer;
    try {
        drawer = std::make_unique<PageDrawer>(workers);
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::usage); // no OpenGL, or built without
        GTEST_SKIP() << error.what();
    }
    const test::ScratchFolder folder;
    const DataFolders nowhere{{}, "nowhere"};
    PageStudio studio{workers, *upsampler, progress, *drawer, nowhere, nowhere, folder.path(), {}};
    const DeformationTask task = bending_task("bar", made_cloud(Shape::bar, 1000, workers, progress), 30);
    PageScene scene;
    scene.name = task.name;
    scene.cloud = task.cloud;
    scene.acts = acts_of(task);
    write_session(studio, scene);
    const auto document = carry_out(studio, scene, scene.settings);
    EXPECT_TRUE(document->is_posed());
    const PagePicture picture = draw_scene(studio, scene, "x", shape_of(studio, *document));
    EXPECT_EQ(replay_command(scene, "--samples 50", picture),
              "knead replay bar.knead --samples 50 --view 0,0 --picture bar-x.png");
    EXPECT_EQ(studio.files, (std::vector<std::string>{"bar.knead", "bar.ply", "bar-x.png"}));
    for (const std::string& name : studio.files) EXPECT_GT(fs::file_size(folder / name), 100U) << name;
    const Session session = read_session(folder / "bar.knead");
    EXPECT_EQ(session.lines.size(), scene.acts.size());
    EXPECT_EQ(session.points, 1000U);
}

} // namespace

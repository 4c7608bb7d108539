// Raw scans that fall apart, made one body and bent.

#include "edit/editing.h"
#include "io/cloud_file.h"
#include "support/scans.h"

namespace knead {
namespace {

using namespace test;

struct RawScan {
    const char* file;
    int axis; // along which it is bent
    double bodies_at_most;
    double largest_share; // of the vertices, at least
};

class BridgedScan : public testing::TestWithParam<RawScan> {};

std::string end_of(const Bounds& bounds, int axis, bool upper, double lower_share = 0.1,
                   double upper_share = 0.8) {
    const double size = bounds.highest[axis] - bounds.lowest[axis];
    HandleLine line;
    line.name = upper ? "top" : "foot";
    line.role = upper ? HandleRole::moving : HandleRole::fixed;
    Vec3d point = bounds.lowest;
    point[axis] += (upper ? upper_share : lower_share) * size;
    line.points = Region(HalfspaceRegion{point, (upper ? 1 : -1) * Vec3d::Unit(axis)});
    return to_text(line) + "\n";
}

TEST_P(BridgedScan, MovesAsOneBody) {
    const RawScan& scan = GetParam();
    KNEAD_SCAN_OR_SKIP(path, scan.file);
    SilentProgress progress;
    PointCloud cloud = read_cloud(path, progress);
    const Bounds bounds = bounds_of(cloud);
    Settings settings;
    settings.strays = Strays::bridge;
    Desk desk(std::move(cloud), settings);
    DragLine bend;
    bend.handle = "top";
    bend.pivot = 0.5 * (bounds.lowest + bounds.highest);
    HandlePose pose;
    pose.rotate = Quatd(Eigen::AngleAxisd(0.5, Vec3d::Unit((scan.axis + 1) % 3)));
    bend.frames = {pose};
    desk.play(end_of(bounds, scan.axis, false) + end_of(bounds, scan.axis, true) + to_text(bend) + "\n" +
              settle(10));
    const Components& bodies = desk.pipeline().components();
    const double largest = *std::ranges::max_element(bodies.size);
    EXPECT_LE(static_cast<double>(bodies.size.size()), scan.bodies_at_most);
    EXPECT_GE(largest / static_cast<double>(bodies.component.size()), scan.largest_share);
    EXPECT_LT(desk.handle_error(), 1e-5);
    EXPECT_TRUE(all_finite(desk.shape()));
}

INSTANTIATE_TEST_SUITE_P(Scan, BridgedScan,
                         testing::Values(RawScan{"buddha_stand_scans.ply", 1, 3, 0.999},
                                         RawScan{"open3d_fragment_196k.ply", 0, 8, 0.99},
                                         RawScan{"lion_takanawa_342k.ply", 1, 24, 0.87}));

// A room as it was scanned from inside: rims all over, and samples whose points lie far beyond their links.
// What such samples took for the stretch around them once grew with every iteration, beyond all floats.
TEST(FewSamples, OfAnOpenScanComeToRest) {
    KNEAD_SCAN_OR_SKIP(path, "open3d_fragment_196k.ply");
    SilentProgress progress;
    const PointCloud cloud = read_cloud(path, progress);
    const Bounds bounds = bounds_of(cloud);
    Eigen::Index longest = 0, shortest = 0;
    (bounds.highest - bounds.lowest).maxCoeff(&longest);
    (bounds.highest - bounds.lowest).minCoeff(&shortest);
    DragLine bend;
    bend.handle = "top";
    bend.pivot = 0.5 * (bounds.lowest + bounds.highest);
    for (int frame = 1; frame <= 5; ++frame) {
        HandlePose pose;
        pose.rotate =
            Quatd(Eigen::AngleAxisd(frame * std::numbers::pi / 15, Vec3d::Unit(3 - longest - shortest)));
        bend.frames.push_back(pose);
    }
    constexpr unsigned iterations = 400;
    const int axis = static_cast<int>(longest);
    const std::string lines = end_of(bounds, axis, false, 0.15) + end_of(bounds, axis, true, 0, 0.85) +
                              to_text(bend) + "\n" + settle(iterations);
    for (const char* samples : {"150", "300"})
        for (const char* strays : {"freeze", "bridge"}) {
            SCOPED_TRACE(std::string(samples) + " samples, " + strays);
            Desk desk(cloud);
            desk.play(set(std::string(R"("samples":)") + samples + R"(,"strays":")" + strays + '"') + lines);
            EXPECT_LT(desk.document().log().iteration.size(), iterations);
            const std::vector<float> shape = desk.shape(), &rest = desk.document().cloud().positions;
            double farthest = 0;
            for (std::size_t i = 0; i < cloud.size(); ++i)
                farthest = std::max(farthest, (at(shape, i) - at(rest, i)).norm());
            EXPECT_LT(farthest, desk.diagonal());
        }
}

} // namespace
} // namespace knead

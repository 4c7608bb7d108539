// A real scan from end to end: the Stanford dragon bows.

#include "edit/editing.h"
#include "edit/replay.h"
#include "io/cloud_file.h"
#include "io/compare.h"
#include "support/scans.h"
#include "support/scratch_folder.h"

namespace knead {
namespace {

using namespace test;

std::string halfspace(const std::string& name, const std::string& role, const Vec3d& point,
                      const Vec3d& normal) {
    HandleLine line;
    line.name = name;
    line.role = role == "fixed" ? HandleRole::fixed : HandleRole::moving;
    line.points = Region(HalfspaceRegion{point, normal});
    return to_text(line) + "\n";
}

TEST(Scan, TheDragonIsBentAndSaved) {
    KNEAD_SCAN_OR_SKIP(path, "dragon.ply");
    SilentProgress progress;
    const ScratchFolder folder;
    const PointCloud dragon = read_cloud(path, progress);
    const Bounds bounds = bounds_of(dragon);
    const Vec3d size = bounds.highest - bounds.lowest;
    const double floor = bounds.lowest.y() + 0.1 * size.y(), brow = bounds.highest.y() - 0.15 * size.y();
    DragLine bow;
    bow.handle = "head";
    bow.pivot = {0.5 * (bounds.lowest.x() + bounds.highest.x()), brow, 0};
    for (int frame = 1; frame <= 5; ++frame) {
        HandlePose pose;
        pose.rotate = Quatd(Eigen::AngleAxisd(0.15 * frame, Vec3d::UnitZ()));
        pose.translate = 0.02 * frame * size;
        bow.frames.push_back(pose);
    }
    write_text(folder / "s.knead", R"({"knead":1,"cloud":{"path":)" + ("\"" + path.string() + "\"") + "}}\n" +
                                       halfspace("feet", "fixed", {0, floor, 0}, {0, -1, 0}) +
                                       halfspace("head", "moving", {0, brow, 0}, {0, 1, 0}) + to_text(bow) +
                                       "\n" + settle(10));
    ReplayOptions options;
    options.out = folder / "out.ply";
    const ReplayReport report =
        replay(read_session(folder / "s.knead"), options, progress, [](const std::string&) {});
    EXPECT_LT(report.handle_error, 1e-5);
    EXPECT_EQ(report.points, dragon.size());

    const PointCloud bent = read_cloud(folder / "out.ply", progress);
    ASSERT_EQ(bent.size(), dragon.size());
    EXPECT_TRUE(attribute_differences(dragon, bent).only_in_a.empty());
    EXPECT_TRUE(attribute_differences(dragon, bent).only_in_b.empty());
    EXPECT_EQ(file_kind(bent).encoding, file_kind(dragon).encoding);
    std::size_t feet = 0, moved = 0;
    for (std::size_t i = 0; i < dragon.size(); ++i) {
        ASSERT_TRUE(is_finite(bent, i));
        if (dragon.file_position(i).y() <= floor) {
            ++feet;
            ASSERT_EQ(bent.file_position(i), dragon.file_position(i));
        }
        moved += bent.file_position(i) != dragon.file_position(i);
    }
    EXPECT_GT(feet, 1000U);
    EXPECT_GT(moved, dragon.size() / 2);
}

} // namespace
} // namespace knead

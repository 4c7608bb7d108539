// Points that lie on lines: wires, poles, the struts of a frame.

#include "edit/editing.h"

#include <algorithm>
#include <numbers>

namespace knead::test {
namespace {

// A wire of so many points along x, from 0 on, a tenth apart.
std::vector<Vec3d> wire(int points) {
    std::vector<Vec3d> line;
    for (int i = 0; i < points; ++i) line.emplace_back(0.1 * i, 0, 0);
    return line;
}

// In floats, seen at a slant, so that no point lies just on its line.
PointCloud at_a_slant(const std::vector<Vec3d>& points) {
    const Quatd slant(Eigen::AngleAxisd(33 * std::numbers::pi / 180, Vec3d(1, 2, 3).normalized()));
    std::vector<float> positions;
    for (const Vec3d& point : points) {
        const Vec3f p = (slant * point).cast<float>();
        positions.insert(positions.end(), {p.x(), p.y(), p.z()});
    }
    return make_cloud(positions);
}

// Nothing but the handle's motion tells a wire how to turn about itself.
TEST(Wires, GoWithTheirHandleAsTheyAre) {
    std::vector<Vec3d> tee = wire(41);
    for (const Vec3d& point : wire(21)) tee.emplace_back(2, 0.1 + point.x(), 0);
    Desk desk(at_a_slant(tee));
    const std::vector<float> before = desk.shape();
    desk.play(R"({"op":"handle","name":"end","role":"moving","points":[[0,2]]})"
              "\n" +
              drag(R"({"translate":[0.5,0,0]})", "end") + settle(300));
    const std::vector<float> after = desk.shape();
    for (std::size_t i = 0; i < tee.size(); ++i)
        ASSERT_LT((at(after, i) - at(before, i) - Vec3d(0.5, 0, 0)).norm(), 1e-4) << i;
}

// Also where nearly every point is a sample, and next to nothing lies between them.
TEST(Wires, ArePressedEvenly) {
    for (const std::uint64_t samples : {40U, 59U}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(at_a_slant(wire(60)), settings);
        const Vec3d end = desk.document().cloud().file_position(59),
                    begin = desk.document().cloud().file_position(0);
        const Vec3d way = -0.35 * (end - begin);
        desk.play(R"({"op":"handle","name":"one","role":"fixed","points":[[0,3]]})"
                  "\n"
                  R"({"op":"handle","name":"other","role":"moving","points":[[56,59]]})"
                  "\n" +
                  drag(R"({"translate":[)" + std::to_string(way.x()) + "," + std::to_string(way.y()) + "," +
                           std::to_string(way.z()) + "]}",
                       "other") +
                  settle(300));
        const std::vector<float> shape = desk.shape();
        const double even = (at(shape, 56) - at(shape, 3)).norm() / 53;
        for (std::size_t i = 3; i < 56; ++i)
            ASSERT_NEAR((at(shape, i + 1) - at(shape, i)).norm() / even, 1, 0.2) << samples << ' ' << i;
    }
}

} // namespace
} // namespace knead::test

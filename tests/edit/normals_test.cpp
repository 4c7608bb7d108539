// Normals stand on the posed surface, wherever turns take up so little of the cloud that the samples' own
// rotations lag behind.

#include "edit/editing.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace knead {
namespace {

using namespace test;

// The direction across the points around one of them, in the order of computation.
Vec3d across(const Graph& graph, const std::vector<Vec3d>& places, Index vertex) {
    Mat3d spread = Mat3d::Zero();
    for (const Index near : graph.row(vertex)) {
        const Vec3d way = places[near] - places[vertex];
        spread += way * way.transpose();
    }
    return Eigen::SelfAdjointEigenSolver<Mat3d>(spread).eigenvectors().col(0);
}

// Degrees between the normals and the surface's, ascending, of the points that are between `inner` and
// `outer` of the middle of a unit square.
std::vector<double> askew(Desk& desk, double inner, double outer) {
    const Pipeline& pipeline = desk.pipeline();
    const std::vector<float> shape = desk.shape(), normals = desk.normals();
    const std::vector<float>& rest = desk.document().cloud().positions;
    const PointOrder& order = pipeline.order();
    std::vector<Vec3d> places;
    for (Index v = 0; v < order.vertices(); ++v)
        places.push_back(at(shape, order.file_index[order.first_point[v]]));
    std::vector<double> angles;
    for (Index v = 0; v < order.vertices(); ++v) {
        const std::size_t point = order.file_index[order.first_point[v]];
        const Vec3d place = at(rest, point) + desk.document().cloud().origin;
        const double radius = std::hypot(place.x() - 0.5, place.y() - 0.5);
        if (!(radius > inner && radius < outer)) continue;
        const double cosine = std::abs(across(pipeline.graph(), places, v).dot(at(normals, point)));
        angles.push_back(180 / std::numbers::pi * std::acos(std::min(1.0, cosine)));
    }
    std::ranges::sort(angles);
    return angles;
}

std::string disc(const std::string& name, const std::string& role, double radius) {
    return R"({"op":"handle","name":")" + name + R"(","role":")" + role +
           R"(","region":{"sphere":{"center":[0.5,0.5,0],"radius":)" + std::to_string(radius) + "}}}\n";
}

// A disc that is lifted within a region of 30 % of the plane's width.
TEST(Normals, StandOnTheSlopeOfASmallBump) {
    for (const std::optional<std::uint64_t> samples :
         {std::optional<std::uint64_t>(5000), std::optional<std::uint64_t>()}) {
        Settings settings;
        settings.samples = samples;
        Desk desk(made(Shape::plane, 20'000), settings);
        desk.play(disc("around", "roi", 0.15) + disc("top", "moving", 0.05) +
                  drag(R"({"translate":[0,0,0.05]},{"translate":[0,0,0.1]})") + settle(60));
        const std::vector<double> angles = askew(desk, 0.06, 0.14);
        ASSERT_GT(angles.size(), 500U);
        EXPECT_LT(angles[angles.size() / 2], 3) << "half of them"; // by the samples' own rotations 20
        EXPECT_LT(angles[angles.size() * 9 / 10], 8) << "all but a tenth";
    }
}

TEST(Normals, StandOnTheSlopeOfALargerBumpOfFewSamples) {
    Settings settings;
    settings.samples = 1000;
    Desk desk(made(Shape::plane, 20'000), settings);
    desk.play(disc("around", "roi", 0.45) + disc("top", "moving", 0.08) +
              drag(R"({"translate":[0,0,0.1]},{"translate":[0,0,0.2]})") + settle(60));
    const std::vector<double> angles = askew(desk, 0.12, 0.42);
    ASSERT_GT(angles.size(), 5000U);
    EXPECT_LT(angles[angles.size() / 2], 2.5) << "half of them"; // by the samples' own rotations 7
    EXPECT_LT(angles[angles.size() * 9 / 10], 8) << "all but a tenth";
}

} // namespace
} // namespace knead

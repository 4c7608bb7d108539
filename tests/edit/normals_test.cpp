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

struct Bump {
    double around, top, height; // the radii of the region and of the disc in it that is lifted, and how far
};

// Half of the normals on its slope stand within `half` degrees, and all but a tenth within 8.
void expect_upright(const Bump& bump, std::optional<std::uint64_t> samples, double half) {
    Settings settings;
    settings.samples = samples;
    Desk desk(made(Shape::plane, 20'000), settings);
    const auto lifted = [&](double part) {
        return R"({"translate":[0,0,)" + std::to_string(part * bump.height) + "]}";
    };
    desk.play(disc("around", "roi", bump.around) + disc("top", "moving", bump.top) +
              drag(lifted(0.5) + "," + lifted(1)) + settle(60));
    const std::vector<double> angles = askew(desk, 1.2 * bump.top, 0.93 * bump.around);
    ASSERT_GT(angles.size(), 500U);
    EXPECT_LT(angles[angles.size() / 2], half);
    EXPECT_LT(angles[angles.size() * 9 / 10], 8);
}

// By the samples' own rotations half of them would be askew by more than 20.
TEST(Normals, StandOnTheSlopeOfASmallBump) {
    expect_upright({0.15, 0.05, 0.1}, 5000, 3);
    expect_upright({0.15, 0.05, 0.1}, std::nullopt, 3);
}

// And here by more than 7.
TEST(Normals, StandOnTheSlopeOfALargerBumpOfFewSamples) {
    expect_upright({0.45, 0.08, 0.2}, 1000, 2.5);
}

} // namespace
} // namespace knead

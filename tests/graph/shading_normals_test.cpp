#include "graph/shading_normals.h"

#include "graph/neighbors.h"
#include "graph/point_order.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace knead::test {
namespace {

TEST(ShadingNormals, stand_on_a_noisy_sphere) {
    std::mt19937 random(3);
    std::normal_distribution<float> normal;
    std::vector<float> positions;
    for (int i = 0; i < 5000; ++i) {
        const Vec3f p = Vec3f(normal(random), normal(random), normal(random)).normalized() *
                        (1 + 0.002f * normal(random)); // a tenth of the spacing, about
        positions.insert(positions.end(), {p.x(), p.y(), p.z()});
    }
    Workers workers(2);
    SilentProgress progress;
    const Graph graph = neighbor_graph(positions, 8, workers, progress);
    const std::vector<float> normals = shading_normals(graph, positions, workers);
    double sum = 0;
    for (std::size_t v = 0; v < graph.size(); ++v) {
        const Vec3f n = Eigen::Map<const Vec3f>(normals.data() + 3 * v);
        EXPECT_NEAR(n.norm(), 1, 1e-5);
        sum += std::abs(n.dot(Eigen::Map<const Vec3f>(positions.data() + 3 * v).normalized()));
    }
    EXPECT_GT(sum / static_cast<double>(graph.size()), std::cos(0.06)); // 3.4° on average
}

// Eight scans of one sphere that lie beside each other by half the points' spacing: neighbours are a lump.
TEST(ShadingNormals, stand_on_scans_that_do_not_fit_each_other) {
    std::mt19937 random(5);
    std::normal_distribution<float> normal;
    std::vector<float> positions;
    for (int scan = 0; scan < 8; ++scan) {
        const Vec3f shift = 0.008F * Vec3f(normal(random), normal(random), normal(random));
        for (int i = 0; i < 10000; ++i) { // 0.035 apart
            const Vec3f p = shift + Vec3f(normal(random), normal(random), normal(random)).normalized();
            positions.insert(positions.end(), {p.x(), p.y(), p.z()});
        }
    }
    Workers workers(2);
    SilentProgress progress;
    const PointOrder order = order_points(positions, workers, progress);
    std::vector<float> ordered(positions.size());
    gather(order, positions, 3, ordered, workers);
    const Graph graph = neighbor_graph(ordered, 6, workers, progress);
    const std::vector<float> normals = shading_normals(graph, ordered, workers);
    std::size_t astray = 0; // by more than 20°
    for (std::size_t v = 0; v < graph.size(); ++v) {
        const Vec3f n = Eigen::Map<const Vec3f>(normals.data() + 3 * v);
        const Vec3f radius = Eigen::Map<const Vec3f>(ordered.data() + 3 * v).normalized();
        astray += std::abs(n.dot(radius)) < std::cos(0.35F) ? 1 : 0;
    }
    EXPECT_LT(astray, graph.size() / 150);
}

TEST(ShadingNormals, are_there_for_lone_vertices_too) {
    Workers workers(1);
    const Graph lone{{0, 0}, {}};
    EXPECT_EQ(shading_normals(lone, std::vector<float>{1, 2, 3}, workers), (std::vector<float>{0, 0, 1}));
    EXPECT_TRUE(shading_normals({}, {}, workers).empty());
    EXPECT_EQ(spread_to_points(std::vector<float>{0, 0, 1, 1, 0, 0}, Numbering({0, 1, 1})),
              (std::vector<float>{0, 0, 1, 1, 0, 0, 1, 0, 0}));
}

} // namespace
} // namespace knead::test

#include "graph/clouds.h"

#include <cmath>
#include <numeric>
#include <queue>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

Graph neighbors(const std::vector<float>& positions, std::size_t k, unsigned threads = 2) {
    Machine machine(threads);
    return neighbor_graph(positions, k, machine.workers, machine.progress);
}

std::vector<double> distances_from(const std::vector<float>& positions, std::size_t v) {
    const auto at = [&](std::size_t u) {
        return Eigen::Map<const Vec3f>(positions.data() + 3 * u).cast<double>();
    };
    std::vector<double> distances(positions.size() / 3);
    for (std::size_t u = 0; u < distances.size(); ++u) distances[u] = (at(u) - at(v)).norm();
    return distances;
}

// Nothing but the k nearest and back links; and all that are surely among the k nearest.
void expect_nearest(const std::vector<float>& positions, std::size_t k, const Graph& graph) {
    const std::size_t vertices = positions.size() / 3;
    ASSERT_EQ(graph.size(), vertices);
    std::vector<double> reach(vertices); // the distance of the k-th
    for (std::size_t v = 0; v < vertices; ++v) {
        std::vector<double> distances = distances_from(positions, v);
        std::ranges::sort(distances);
        reach[v] = distances[k]; // the first is the vertex itself
    }
    for (Index v = 0; v < vertices; ++v) {
        ASSERT_GE(graph.row(v).size(), k);
        const std::vector<double> distances = distances_from(positions, v);
        for (Index u = 0; u < vertices; ++u) {
            if (u == v) continue;
            const bool linked = find_link(graph, v, u).has_value();
            const double farthest = std::max(reach[u], reach[v]);
            if (linked) {
                ASSERT_LE(distances[u], farthest) << v << " and " << u;
            } else {
                ASSERT_GE(distances[u], farthest) << v << " and " << u;
            }
        }
    }
}

TEST(NeighborGraph, LinksTheNearestAndBack) {
    const std::vector<std::vector<float>> clouds = {
        test::random_positions(600, 1), test::shape_positions(Shape::sphere, 500),
        test::shape_positions(Shape::creature, 700), test::grid_positions(20, 20)};
    for (const auto& positions : clouds) {
        for (const std::size_t k : {1U, 2U, 6U, 20U}) {
            const Graph graph = neighbors(positions, k);
            test::expect_well_formed(graph);
            expect_nearest(positions, k, graph);
        }
    }
}

TEST(NeighborGraph, LinksAllToAllWhereThereAreFew) {
    const std::vector<float> positions = test::random_positions(9, 2);
    for (const std::size_t k : {8U, 9U, 64U}) {
        const Graph graph = neighbors(positions, k);
        test::expect_well_formed(graph);
        EXPECT_EQ(graph.neighbor.size(), 72U);
    }
}

TEST(NeighborGraph, AcceptsNoneOneAndTwo) {
    EXPECT_EQ(neighbors({}, 6).size(), 0U);
    const Graph one = neighbors({1, 2, 3}, 6);
    EXPECT_EQ(one.size(), 1U);
    EXPECT_TRUE(one.neighbor.empty());
    const Graph two = neighbors({1, 2, 3, 4, 5, 6}, 6);
    EXPECT_EQ(two.neighbor, (std::vector<Index>{1, 0}));
}

TEST(NeighborGraph, DoesNotDependOnTheUnit) {
    const std::vector<float> positions = test::shape_positions(Shape::creature, 3000);
    const Graph expected = neighbors(positions, 6);
    for (const int exponent : {-100, 100}) { // about 1e-30 and 1e30; a power of two rounds nothing
        std::vector<float> scaled = positions;
        for (float& value : scaled) value = std::ldexp(value, exponent);
        EXPECT_TRUE(test::same_graph(neighbors(scaled, 6), expected)) << "scaled by 2^" << exponent;
    }
}

TEST(NeighborGraph, IsTheSameForAnyNumberOfThreads) {
    const std::vector<float> positions = test::shape_positions(Shape::knot, 20000);
    const Graph one = neighbors(positions, 6, 1);
    EXPECT_TRUE(test::same_graph(neighbors(positions, 6, 2), one));
    EXPECT_TRUE(test::same_graph(neighbors(positions, 6, 5), one));
}

TEST(NeighborGraph, TellsDistancesWhoseSquaresVanishInFloat) {
    std::vector<float> positions{1, 0, 0};
    for (int i = 0; i < 40; ++i) test::append(positions, Vec3d(1e-25 * (i + 1), 0, 0));
    const Graph graph = neighbors(positions, 6);
    test::expect_well_formed(graph);
    expect_nearest(positions, 6, graph);
}

TEST(NeighborGraph, StopsWhenToldTo) {
    struct Stopped final : Progress {
        void report(std::string_view, double) override {}
        bool cancelled() const override { return true; }
    } stopped;
    Workers workers(2);
    EXPECT_THROW(neighbor_graph(test::random_positions(100, 3), 6, workers, stopped), Cancelled);
}

// Which vertices a breadth-first search from each yet unseen vertex finds.
std::vector<Index> plain_components(const Graph& graph) {
    std::vector<Index> component(graph.size(), no_index);
    Index count = 0;
    for (Index start = 0; start < graph.size(); ++start) {
        if (component[start] != no_index) continue;
        std::queue<Index> waiting({start});
        component[start] = count;
        for (; !waiting.empty(); waiting.pop()) {
            for (const Index u : graph.row(waiting.front())) {
                if (component[u] != no_index) continue;
                component[u] = count;
                waiting.push(u);
            }
        }
        ++count;
    }
    return component;
}

void expect_plain_components(const Graph& graph) {
    const Components found = test::components_of(graph);
    const std::vector<Index> plain = plain_components(graph);
    EXPECT_EQ(found.component.of_all(), plain);
    std::vector<Index> size(found.size.size(), 0);
    for (const Index c : plain) ++size.at(c);
    EXPECT_EQ(found.size, size);
}

TEST(Components, AreThoseOfABreadthFirstSearch) {
    for (const std::size_t k : {1U, 2U, 3U, 6U}) { // with k = 1 hundreds of them
        expect_plain_components(neighbors(test::random_positions(2000, 4), k));
        expect_plain_components(neighbors(test::shape_positions(Shape::creature, 3000), k));
    }
    for (const std::size_t k : {1U, 2U}) // joined by several workers, and between what they join
        expect_plain_components(neighbors(test::random_positions(50'000, 5), k));
    expect_plain_components(test::cloud_of(test::two_patches(false)).graph);
    expect_plain_components(Graph{});
    expect_plain_components(neighbors({1, 2, 3}, 6));
}

TEST(Components, OfTwoPatchesAreTwoUntilANeckJoinsThem) {
    EXPECT_EQ(test::cloud_of(test::two_patches(false)).components.size.size(), 2U);
    EXPECT_EQ(test::cloud_of(test::two_patches(true)).components.size.size(), 1U);
}

} // namespace
} // namespace knead

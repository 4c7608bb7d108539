#include "graph/distances.h"

#include "graph/clouds.h"

#include <algorithm>

namespace knead {
namespace {

using test::Cloud;

// The yardstick: relaxing all links until nothing changes (Bellman and Ford).
std::vector<double> by_relaxation(const Cloud& cloud, const std::vector<Index>& sources) {
    std::vector<double> distance(cloud.size(), 1e300);
    for (const Index source : sources) distance[source] = 0;
    for (bool changed = true; changed;) {
        changed = false;
        for (Index v = 0; v < cloud.graph.size(); ++v)
            for (const Index u : cloud.graph.row(v)) {
                const double way = distance[v] + (cloud.at(u) - cloud.at(v)).norm();
                if (way >= distance[u]) continue;
                distance[u] = way;
                changed = true;
            }
    }
    return distance;
}

TEST(ReachedWithin, IsAllThatIsNearInOrder) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 1500));
    const std::vector<Index> sources{3, 700, 701};
    const std::vector<double> expected = by_relaxation(cloud, sources);
    constexpr double limit = 0.4;
    const auto reached = reached_within(cloud.graph, cloud.positions, sources, limit);
    std::size_t near = 0;
    for (const double distance : expected) near += distance <= limit;
    ASSERT_EQ(reached.size(), near);
    EXPECT_GT(near, sources.size());
    for (std::size_t r = 0; r < reached.size(); ++r) {
        EXPECT_NEAR(reached[r].distance, expected[reached[r].vertex], 1e-12); // sums in another order
        if (r > 0) {
            EXPECT_GE(reached[r].distance, reached[r - 1].distance);
        }
    }
}

// Two spheres far from each other.
Cloud two_spheres() {
    std::vector<float> positions = test::shape_positions(Shape::sphere, 300);
    const std::size_t of_one = positions.size();
    for (std::size_t i = 0; i < of_one; ++i) positions.push_back(positions[i] + (i % 3 == 0 ? 9.0F : 0.0F));
    return test::cloud_of(positions);
}

TEST(ReachedWithin, NeedsASourceAndStaysInItsPart) {
    const Cloud cloud = two_spheres();
    ASSERT_EQ(cloud.components.size, (std::vector<Index>{300, 300}));
    EXPECT_TRUE(reached_within(cloud.graph, cloud.positions, {}, 100).empty());
    const std::vector<Index> source{5};
    const auto only = reached_within(cloud.graph, cloud.positions, source, 0);
    ASSERT_EQ(only.size(), 1U);
    EXPECT_EQ(only[0].vertex, 5U);
    const auto part = reached_within(cloud.graph, cloud.positions, source, 100);
    EXPECT_EQ(part.size(), 300U);
    for (const Reached& one : part) {
        EXPECT_EQ(cloud.components.component[one.vertex], cloud.components.component[5]);
        EXPECT_EQ(one.source, 5U);
    }
}

TEST(ReachedWithin, TellsWhichSourceIsNearest) {
    const Cloud cloud = two_spheres();
    const std::vector<Index> sources{5, 250, 400};
    std::vector<std::vector<double>> from_each;
    for (const Index source : sources) from_each.push_back(by_relaxation(cloud, {source}));
    const auto reached = reached_within(cloud.graph, cloud.positions, sources, 100);
    EXPECT_EQ(reached.size(), cloud.size());
    for (const Reached& one : reached) {
        const auto source = std::ranges::find(sources, one.source) - sources.begin();
        ASSERT_LT(static_cast<std::size_t>(source), sources.size());
        EXPECT_NEAR(from_each[static_cast<std::size_t>(source)][one.vertex], one.distance, 1e-12);
        for (const std::vector<double>& other : from_each) EXPECT_LE(one.distance, other[one.vertex] + 1e-12);
    }
}

} // namespace
} // namespace knead

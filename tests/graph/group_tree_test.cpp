// The nearest vertex of another group, against looking at all of them.

#include "graph/group_tree.h"

#include "graph/clouds.h"

namespace knead {
namespace {

using namespace test;

// `reach`: of each vertex; the nearest is within that of both.
Neighbor by_looking_at_all(const Cloud& cloud, std::span<const Index> group, std::size_t v,
                           std::span<const float> reach) {
    Neighbor best;
    for (Index u = 0; u < cloud.size(); ++u) {
        if (group[u] == no_index || group[u] == group[v]) continue;
        const double distance = (cloud.at(v) - cloud.at(u)).norm();
        if (distance <= reach[v] && distance <= reach[u] && distance < best.distance) best = {u, distance};
    }
    return best;
}

Neighbor by_looking_at_all(const Cloud& cloud, std::span<const Index> group, std::size_t v, double reach) {
    Neighbor best;
    for (Index u = 0; u < cloud.size(); ++u) {
        if (group[u] == no_index || group[u] == group[v]) continue;
        const double distance = (cloud.at(v) - cloud.at(u)).norm();
        if (distance <= reach && distance < best.distance) best = {u, distance};
    }
    return best;
}

// Groups in lumps, as components are, some of them of nobody.
std::vector<Index> lumps(const Cloud& cloud) {
    std::vector<Index> group(cloud.size());
    for (std::size_t v = 0; v < group.size(); ++v) {
        const int slice = static_cast<int>(std::floor(3 * cloud.at(v).x())); // below 0 on one side
        group[v] = static_cast<Index>((slice % 4 + 4) % 4);
        if (v % 29 == 0) group[v] = no_index;
    }
    return group;
}

TEST(GroupTree, FindsWhatLookingAtAllFinds) {
    Machine machine;
    for (const auto& [name, cloud] : several_clouds()) {
        const std::vector<Index> group = lumps(cloud);
        const GroupTree tree = group_tree(cloud.positions, group, machine.workers);
        for (const double reach : {0.0, 0.2, 2.0, std::numeric_limits<double>::infinity()}) {
            for (std::size_t v = 0; v < cloud.size(); v += 7) {
                const Neighbor found = nearest_of_others(tree, v, reach);
                const Neighbor expected = by_looking_at_all(cloud, group, v, reach);
                ASSERT_EQ(found.vertex, expected.vertex) << name << ", vertex " << v << ", reach " << reach;
                ASSERT_DOUBLE_EQ(found.distance, expected.distance);
            }
        }
    }
}

TEST(GroupTree, FindsWhatReachesBack) {
    Machine machine;
    for (const auto& [name, cloud] : several_clouds()) {
        const std::vector<Index> group = lumps(cloud);
        const GroupTree tree = group_tree(cloud.positions, group, machine.workers);
        std::vector<float> reach(cloud.size());
        for (std::size_t v = 0; v < reach.size(); ++v) reach[v] = 0.05F * static_cast<float>(v % 11);
        for (std::size_t v = 0; v < cloud.size(); v += 7) {
            const Neighbor found = nearest_within_both(tree, v, reach);
            const Neighbor expected = by_looking_at_all(cloud, group, v, reach);
            ASSERT_EQ(found.vertex, expected.vertex) << name << ", vertex " << v;
            ASSERT_DOUBLE_EQ(found.distance, expected.distance);
        }
    }
}

TEST(GroupTree, FindsNothingWhereThereAreNoOthers) {
    Machine machine;
    const Cloud cloud = cloud_of(grid_positions(5, 5));
    for (const Index of_all : {Index{3}, no_index}) {
        const std::vector<Index> group(cloud.size(), of_all);
        const GroupTree tree = group_tree(cloud.positions, group, machine.workers);
        EXPECT_EQ(nearest_of_others(tree, 7, 1e30).vertex, no_index);
    }
}

} // namespace
} // namespace knead

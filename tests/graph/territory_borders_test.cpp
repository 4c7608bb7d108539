// Borders of territories: counted link by link, and followed through a change of the samples.

#include "graph/clouds.h"
#include "graph/territory_borders.h"

#include <map>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

// Counted for every link from both ends, in the plainest way.
std::vector<TerritoryBorder> counted(const Cloud& cloud, const InfluenceRows& nearest) {
    std::map<std::pair<Index, Index>, Index> links;
    for (Index p = 0; p < cloud.size(); ++p)
        for (const Index q : cloud.graph.row(p)) {
            const Index a = nearest[p].sample[0], b = nearest[q].sample[0];
            if (a < b) ++links[{a, b}];
        }
    std::vector<TerritoryBorder> borders;
    for (const auto& [pair, crossing] : links) borders.push_back({pair.first, pair.second, crossing});
    return borders;
}

TEST(TerritoryBorders, AreTheLinksBetweenTerritories) {
    for (const auto& [name, cloud] : test::several_clouds())
        for (const std::size_t samples : {0U, 1U, 5U, 150U}) {
            SCOPED_TRACE(name + ", " + std::to_string(samples) + " samples");
            Machine machine;
            const InfluenceRows nearest =
                flood(cloud.graph, cloud.lengths, test::random_vertices(cloud.size(), samples, 3),
                      machine.workers, machine.progress);
            EXPECT_EQ(territory_borders(nearest, cloud.graph, machine.workers), counted(cloud, nearest));
        }
}

TEST(TerritoryBorders, FollowAddedSamples) {
    auto clouds = test::several_clouds();
    clouds.push_back({"of several tiles", test::cloud_of(test::shape_positions(Shape::knot, 20'000))});
    for (const auto& [name, cloud] : clouds)
        for (const std::size_t base : {0U, 1U, 60U})
            for (const std::size_t more : {0U, 1U, 40U}) {
                SCOPED_TRACE(name + ", " + std::to_string(base) + " and " + std::to_string(more));
                Machine machine;
                const std::vector<Index> samples = test::random_vertices(cloud.size(), base + more, 6);
                const std::vector<Index> old(samples.begin(), samples.begin() + static_cast<int>(base));
                const std::vector<Index> added(samples.begin() + static_cast<int>(base), samples.end());
                InfluenceRows nearest =
                    flood(cloud.graph, cloud.lengths, old, machine.workers, machine.progress);
                const auto before = territory_borders(nearest, cloud.graph, machine.workers);
                const FloodPatch patch =
                    add_samples(nearest, cloud.graph, cloud.lengths, added, static_cast<Index>(base),
                                machine.workers, machine.progress);
                EXPECT_EQ(territory_borders_after(before, patch, nearest, cloud.graph, machine.workers),
                          counted(cloud, nearest));
            }
}

TEST(TerritoryBorders, FollowSamplesThatMakeRowsWide) {
    const Cloud cloud = test::cloud_of(test::grid_positions(260, 255)); // 66,300 vertices
    Machine machine;
    const std::vector<Index> all = test::random_vertices(cloud.size(), cloud.size(), 1);
    const std::vector<Index> samples(all.begin(), all.begin() + 65'000),
        added(all.begin() + 65'000, all.end());
    InfluenceRows nearest = flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
    ASSERT_FALSE(nearest.are_wide());
    const auto before = territory_borders(nearest, cloud.graph, machine.workers);
    const FloodPatch patch =
        add_samples(nearest, cloud.graph, cloud.lengths, added, static_cast<Index>(samples.size()),
                    machine.workers, machine.progress);
    ASSERT_TRUE(nearest.are_wide());
    EXPECT_EQ(territory_borders_after(before, patch, nearest, cloud.graph, machine.workers),
              counted(cloud, nearest));
}

TEST(TerritoryBorders, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 40'000));
    Machine two;
    const InfluenceRows nearest =
        flood(cloud.graph, cloud.lengths, test::random_vertices(40'000, 900, 2), two.workers, two.progress);
    const auto expected = territory_borders(nearest, cloud.graph, two.workers);
    for (const unsigned threads : {1U, 5U}) {
        Machine machine(threads);
        EXPECT_EQ(territory_borders(nearest, cloud.graph, machine.workers), expected);
    }
}

} // namespace
} // namespace knead

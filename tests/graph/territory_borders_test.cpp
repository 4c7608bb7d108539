// Borders of territories: counted link by link, and followed through a change of the samples.

#include "graph/clouds.h"
#include "graph/counted_borders.h"
#include "graph/territory_borders.h"

#include <algorithm>

namespace knead {
namespace {

using test::Cloud;
using test::counted;
using test::Machine;

TerritoryRows flooded(const Cloud& cloud, const std::vector<Index>& samples, Machine& machine) {
    return territory_rows(flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress),
                          machine.workers);
}

TEST(TerritoryBorders, AreTheLinksBetweenTerritories) {
    for (const auto& [name, cloud] : test::several_clouds())
        for (const std::size_t samples : {0U, 1U, 5U, 150U}) {
            SCOPED_TRACE(name + ", " + std::to_string(samples) + " samples");
            Machine machine;
            const TerritoryRows nearest =
                flooded(cloud, test::random_vertices(cloud.size(), samples, 3), machine);
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
                TerritoryRows nearest = flooded(cloud, old, machine);
                const auto before = territory_borders(nearest, cloud.graph, machine.workers);
                const auto first_added = static_cast<Index>(base);
                AddedStarts<1> starts = no_starts(nearest, first_added);
                const TerritoryPatch patch =
                    change_starts(starts, starts_of(added, first_added), nearest, cloud.graph, cloud.lengths,
                                  machine.workers, machine.progress);
                EXPECT_EQ(territory_borders_after(before, patch, starts, nearest, cloud.graph, cloud.lengths,
                                                  machine.workers),
                          counted(cloud, flooded(cloud, samples, machine), first_added));
            }
}

TEST(TerritoryBorders, FollowSamplesThatMakeRowsWide) {
    const Cloud cloud = test::cloud_of(test::grid_positions(260, 255)); // 66,300 vertices
    Machine machine;
    const std::vector<Index> all = test::random_vertices(cloud.size(), cloud.size(), 1);
    const std::vector<Index> samples(all.begin(), all.begin() + 65'000),
        added(all.begin() + 65'000, all.end());
    TerritoryRows nearest = flooded(cloud, samples, machine);
    ASSERT_FALSE(nearest.are_wide());
    const auto before = territory_borders(nearest, cloud.graph, machine.workers);
    const auto first_added = static_cast<Index>(samples.size());
    AddedStarts<1> starts = no_starts(nearest, first_added);
    const TerritoryPatch patch = change_starts(starts, starts_of(added, first_added), nearest, cloud.graph,
                                               cloud.lengths, machine.workers, machine.progress);
    ASSERT_TRUE(nearest.are_wide());
    EXPECT_EQ(
        territory_borders_after(before, patch, starts, nearest, cloud.graph, cloud.lengths, machine.workers),
        counted(cloud, nearest, first_added));
}

TEST(TerritoryBorders, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 40'000));
    Machine two;
    const TerritoryRows nearest = flooded(cloud, test::random_vertices(40'000, 900, 2), two);
    const auto expected = territory_borders(nearest, cloud.graph, two.workers);
    for (const unsigned threads : {1U, 5U}) {
        Machine machine(threads);
        EXPECT_EQ(territory_borders(nearest, cloud.graph, machine.workers), expected);
    }
}

} // namespace
} // namespace knead

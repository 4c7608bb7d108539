// Borders of territories: counted link by link, and followed through a change of the samples.

#include "graph/clouds.h"
#include "graph/territory_borders.h"

#include <algorithm>
#include <map>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

TerritoryRows flooded(const Cloud& cloud, const std::vector<Index>& samples, Machine& machine) {
    return territory_rows(flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress),
                          machine.workers);
}

// Counted for every link from both ends, in the plainest way. Samples from `first_added` on were added.
std::vector<TerritoryBorder> counted(const Cloud& cloud, const TerritoryRows& nearest,
                                     Index first_added = no_index) {
    std::map<std::pair<Index, Index>, TerritoryBorder> borders;
    for (Index p = 0; p < cloud.size(); ++p)
        for (Index link = cloud.graph.first[p]; link < cloud.graph.first[p + 1]; ++link) {
            const TerritoryRows::Wide here = nearest[p], there = nearest[cloud.graph.neighbor[link]];
            const Index a = here.sample[0], b = there.sample[0];
            if (!(a < b)) continue;
            TerritoryBorder& border = borders[{a, b}];
            border.a = a;
            border.b = b;
            ++border.links;
            if (b >= first_added)
                border.way = std::min(border.way, here.distance[0] + cloud.lengths[link] + there.distance[0]);
        }
    std::vector<TerritoryBorder> result;
    for (const auto& [pair, border] : borders) result.push_back(border);
    return result;
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
                const TerritoryPatch patch =
                    add_territories(nearest, cloud.graph, cloud.lengths, starts_of(added, first_added),
                                    machine.workers, machine.progress);
                EXPECT_EQ(territory_borders_after(before, patch, nearest, cloud.graph, cloud.lengths,
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
    const TerritoryPatch patch = add_territories(nearest, cloud.graph, cloud.lengths,
                                                 starts_of(added, static_cast<Index>(samples.size())),
                                                 machine.workers, machine.progress);
    ASSERT_TRUE(nearest.are_wide());
    EXPECT_EQ(territory_borders_after(before, patch, nearest, cloud.graph, cloud.lengths, machine.workers),
              counted(cloud, nearest, static_cast<Index>(samples.size())));
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

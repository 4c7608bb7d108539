// Samples that come and go anywhere in their list: borders are always those of the samples that there are.

#include "graph/changing_territories.h"
#include "graph/clouds.h"
#include "graph/counted_borders.h"

#include <random>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

InfluenceRows flooded(const Cloud& cloud, const std::vector<Index>& samples, Machine& machine) {
    return flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
}

// Territories of some base samples, and what they are as if all samples had been there from the start.
struct Changing {
    const Cloud& cloud;
    std::vector<Index> base;
    Machine machine;
    ChangingTerritories territories;
    std::vector<Index> nearest; // base samples

    Changing(const Cloud& of, std::size_t samples)
        : cloud(of), base(test::random_vertices(of.size(), samples, 8)) {
        const InfluenceRows rows = flooded(cloud, base, machine);
        territories = territories_of_base(rows, base.size(), cloud.graph, machine.workers);
        for (Index v = 0; v < cloud.size(); ++v) nearest.push_back(rows[v].sample[0]);
    }

    void change(const std::vector<Index>& added) {
        const std::vector<TerritoryBorder> borders =
            change_added(territories, added, cloud.graph, cloud.lengths, machine.workers, machine.progress);
        std::vector<Index> all = base;
        all.insert(all.end(), added.begin(), added.end());
        const TerritoryRows at_once = territory_rows(flooded(cloud, all, machine), machine.workers);
        ASSERT_EQ(borders, test::counted(cloud, at_once, static_cast<Index>(base.size())));
        const std::vector<Index> some = test::random_vertices(cloud.size(), 300, 2);
        const std::vector<Index> of_base = nearest_of_base(territories, some);
        for (std::size_t i = 0; i < some.size(); ++i) ASSERT_EQ(of_base[i], nearest[some[i]]);
    }
};

TEST(ChangingTerritories, AreThoseOfTheSamplesThatThereAre) {
    auto clouds = test::several_clouds();
    clouds.push_back({"of several tiles", test::cloud_of(test::shape_positions(Shape::knot, 20'000))});
    for (const auto& [name, cloud] : clouds)
        for (const std::size_t base : {0U, 3U, 60U}) {
            SCOPED_TRACE(name + ", " + std::to_string(base));
            Changing changing(cloud, base);
            std::mt19937 random(4);
            std::vector<Index> added;
            for (int step = 0; step < 25; ++step) {
                SCOPED_TRACE("step " + std::to_string(step));
                // Some go, and some come next to each other, as those of a handle do.
                std::erase_if(added, [&](Index) { return random() % 6 == 0; });
                auto vertex = static_cast<Index>(random() % cloud.size());
                const auto place = added.begin() + static_cast<std::ptrdiff_t>(random() % (added.size() + 1));
                std::vector<Index> more;
                for (auto count = random() % 7; count > 0;
                     --count, vertex = static_cast<Index>((vertex + 3) % cloud.size()))
                    if (std::ranges::find(changing.base, vertex) == changing.base.end() &&
                        std::ranges::find(added, vertex) == added.end() &&
                        std::ranges::find(more, vertex) == more.end())
                        more.push_back(vertex);
                added.insert(place, more.begin(), more.end());
                changing.change(added);
            }
            changing.change({});
        }
}

// All of an order that changes, and more than there is room for between others.
TEST(ChangingTerritories, TakeAnyOrder) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 3000));
    Changing changing(cloud, 20);
    std::vector<Index> added = test::random_vertices(cloud.size(), 150, 5);
    std::erase_if(added, [&](Index v) { return std::ranges::find(changing.base, v) != changing.base.end(); });
    const std::vector<Index> few(added.begin(), added.begin() + 4);
    changing.change(few);
    changing.change(added);
    std::ranges::reverse(added);
    changing.change(added);
    std::ranges::rotate(added, added.begin() + 30);
    changing.change(added);
    changing.change(few);
}

TEST(ChangingTerritories, OutgrowNarrowRows) {
    const Cloud cloud = test::cloud_of(test::grid_positions(260, 255)); // 66,300 vertices
    Machine machine;
    const std::vector<Index> all = test::random_vertices(cloud.size(), cloud.size(), 1);
    const std::vector<Index> base(all.begin(), all.begin() + 65'500);
    ChangingTerritories territories =
        territories_of_base(flooded(cloud, base, machine), base.size(), cloud.graph, machine.workers);
    ASSERT_FALSE(territories.nearest.are_wide());
    for (const std::ptrdiff_t more : {20, 300, 25}) { // of which narrow rows can tell 34 at most
        const std::vector<Index> added(all.begin() + 65'500, all.begin() + 65'500 + more);
        const auto borders =
            change_added(territories, added, cloud.graph, cloud.lengths, machine.workers, machine.progress);
        const std::vector<Index> both(all.begin(), all.begin() + 65'500 + more);
        const TerritoryRows at_once = territory_rows(flooded(cloud, both, machine), machine.workers);
        EXPECT_TRUE(borders == test::counted(cloud, at_once, 65'500));
    }
}

} // namespace
} // namespace knead

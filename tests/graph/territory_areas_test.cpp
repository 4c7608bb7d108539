#include "graph/territory_areas.h"

#include "graph/clouds.h"

#include <algorithm>
#include <numeric>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

// Territories of base samples, and of others that may be added.
struct Divided {
    Machine machine;
    const Cloud& cloud;
    std::vector<Index> samples;
    ChangingTerritories territories;

    Divided(const Cloud& of, std::size_t base)
        : cloud(of), samples(test::shuffled_in_runs(test::octree_of(of, base))) {
        const InfluenceRows rows =
            flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
        territories = territories_of_base(rows, samples.size(), cloud.graph, machine.workers);
    }

    void add(const std::vector<Index>& added) {
        change_added(territories, added, cloud.graph, cloud.lengths, machine.workers, machine.progress);
        samples.insert(samples.end(), added.begin(), added.end());
    }

    AskedVertices asked(std::size_t of_samples, const std::vector<std::uint8_t>& hanging = {}) {
        return ask_vertices(cloud.graph, cloud.positions, Numbering::as_they_stand(cloud.size()), hanging,
                            of_samples, machine.workers);
    }

    std::vector<double> areas(const AskedVertices& of) {
        return territory_areas(of, territories, samples.size(), machine.workers);
    }
};

TEST(TerritoryAreas, AreThoseOfTheVerticesThatTheyHold) {
    constexpr int edge = 40;
    const Cloud grid = test::cloud_of(test::grid_positions(edge, edge), 4);
    Divided divided(grid, 100);
    const AskedVertices all = divided.asked(edge * edge);
    ASSERT_EQ(all.vertex.size(), grid.size());
    EXPECT_EQ(all.each, 1);
    const std::vector<double> area = divided.areas(all);
    // Weights of 6 in all, of links of length 1; near the rim there are others.
    std::vector<int> inside(area.size(), 0);
    std::vector<bool> near_rim(area.size(), false);
    for (Index v = 0; v < grid.size(); ++v) {
        const Index own = divided.territories.nearest[v].sample[0];
        const Vec3d p = grid.at(v);
        ++inside[own];
        if (p.head<2>().minCoeff() < 2 || p.head<2>().maxCoeff() > edge - 3) near_rim[own] = true;
    }
    ASSERT_GT(std::ranges::count(near_rim, false), 20);
    for (std::size_t s = 0; s < area.size(); ++s) {
        if (near_rim[s])
            EXPECT_LT(area[s], 6.01 * inside[s]);
        else
            EXPECT_NEAR(area[s], 6 * inside[s], 1e-5 * area[s]);
    }
}

TEST(TerritoryAreas, OfSomeVerticesAreNearThoseOfAll) {
    const Cloud cloud =
        test::cloud_of(test::shape_positions(Shape::bar, 20'000, 20)); // 20 times denser at one end
    Divided divided(cloud, 100);
    const AskedVertices some = divided.asked(100);
    ASSERT_LT(some.vertex.size(), cloud.size() / 5);
    EXPECT_TRUE(std::ranges::is_sorted(some.vertex));
    const std::vector<double> area = divided.areas(some);
    const std::vector<double> exact = divided.areas(divided.asked(cloud.size()));
    double off = 0, all = 0;
    for (std::size_t s = 0; s < area.size(); ++s) {
        off += std::abs(area[s] - exact[s]);
        all += exact[s];
    }
    EXPECT_LT(off, 0.15 * all); // of 16 a sample
    EXPECT_NEAR(std::accumulate(area.begin(), area.end(), 0.0), all, 0.03 * all);
}

TEST(TerritoryAreas, GoToSamplesThatAreAddedAndBack) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 3000));
    Divided divided(cloud, 40);
    const AskedVertices asked = divided.asked(cloud.size());
    const std::vector<double> before = divided.areas(asked);
    std::vector<Index> added;
    for (const Index v : test::random_vertices(cloud.size(), 12, 3))
        if (std::ranges::find(divided.samples, v) == divided.samples.end()) added.push_back(v);
    divided.add(added);
    const std::vector<double> with = divided.areas(asked);
    ASSERT_EQ(with.size(), before.size() + added.size());
    const auto sum = [](const std::vector<double>& area) {
        return std::accumulate(area.begin(), area.end(), 0.0);
    };
    EXPECT_NEAR(sum(with), sum(before), 1e-9 * sum(before));
    for (std::size_t s = 0; s < before.size(); ++s) EXPECT_LE(with[s], before[s]);
    for (std::size_t s = before.size(); s < with.size(); ++s) EXPECT_GT(with[s], 0);
    change_added(divided.territories, {}, cloud.graph, cloud.lengths, divided.machine.workers,
                 divided.machine.progress);
    divided.samples.resize(before.size());
    EXPECT_EQ(divided.areas(asked), before);
}

TEST(TerritoryAreas, KnowNothingOfOutliersThatHang) {
    std::vector<float> positions = test::grid_positions(20, 20);
    const Cloud plain = test::cloud_of(positions, 4);
    test::append(positions, Vec3d(10, 10, 7)); // is linked to some of the grid
    const Cloud cloud = test::cloud_of(positions, 4);
    std::vector<std::uint8_t> hanging(cloud.size(), 0);
    for (std::size_t v = 0; v < cloud.size(); ++v) hanging[v] = cloud.at(v).z() > 1;
    Divided divided(cloud, 10), without(plain, 10);
    const auto sum = [](const AskedVertices& asked) {
        return std::accumulate(asked.area.begin(), asked.area.end(), 0.0);
    };
    const double all = sum(without.asked(plain.size()));
    EXPECT_NEAR(sum(divided.asked(cloud.size(), hanging)), all, 1e-3 * all);
    EXPECT_GT(sum(divided.asked(cloud.size())), 1.03 * all);
}

TEST(TerritoryAreas, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 5000));
    Divided divided(cloud, 60);
    const AskedVertices asked = divided.asked(60);
    const std::vector<double> area = divided.areas(asked);
    for (const unsigned threads : {1U, 5U}) {
        Workers workers(threads);
        const AskedVertices again = ask_vertices(cloud.graph, cloud.positions,
                                                 Numbering::as_they_stand(cloud.size()), {}, 60, workers);
        EXPECT_EQ(again.vertex, asked.vertex);
        EXPECT_EQ(again.area, asked.area);
        EXPECT_EQ(territory_areas(again, divided.territories, divided.samples.size(), workers), area);
    }
}

TEST(TerritoryAreas, OfNoSamplesAreNone) {
    const Cloud cloud = test::cloud_of(test::grid_positions(4, 4), 4);
    Machine machine;
    const AskedVertices asked = ask_vertices(cloud.graph, cloud.positions,
                                             Numbering::as_they_stand(cloud.size()), {}, 0, machine.workers);
    EXPECT_TRUE(asked.vertex.empty());
    EXPECT_TRUE(territory_areas(asked, {}, 0, machine.workers).empty());
}

} // namespace
} // namespace knead

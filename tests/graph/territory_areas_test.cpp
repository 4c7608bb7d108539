#include "graph/territory_areas.h"

#include "graph/clouds.h"

#include <algorithm>
#include <cmath>
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

    AskedVertices asked(std::size_t of_samples) { return ask(16 * of_samples, 1, machine.workers); }

    AskedVertices ask(std::size_t count, std::size_t of_cells, Workers& workers) const {
        return ask_vertices(cloud.graph, cloud.positions, Numbering::as_they_stand(cloud.size()), {},
                            choose_by_area(cloud.graph, cloud.lengths, {}, count, workers), of_cells,
                            workers);
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
    EXPECT_TRUE(all.all);
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

// Some of very many points, picked at random: the cells of some tell little of the others', those of all
// around much.
TEST(TerritoryAreas, OfSomeVerticesAreLevelledToWhatIsAround) {
    const Cloud cloud = test::cloud_of(test::picked(test::shape_positions(Shape::sphere, 200'000), 20));
    Divided divided(cloud, 100);
    AskedVertices some = divided.asked(60);
    const std::vector<double> exact = divided.areas(divided.asked(cloud.size()));
    const auto off = [&] {
        const std::vector<double> area = divided.areas(some);
        double squares = 0;
        for (std::size_t s = 0; s < area.size(); ++s) squares += std::pow(area[s] / exact[s] - 1, 2);
        return std::sqrt(squares / static_cast<double>(area.size()));
    };
    const double before = off();
    const std::vector<float> of_links = level_areas(some, divided.territories, divided.samples.size());
    EXPECT_LT(off(), 0.95 * before);
    ASSERT_EQ(of_links.size(), divided.samples.size());
    for (const float each : of_links) EXPECT_NEAR(each, 1.03, 0.25); // of even ones it is 0.9
}

TEST(TerritoryAreas, OfAllVerticesStayWhatTheyAre) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::sphere, 3000));
    Divided divided(cloud, 50);
    const AskedVertices asked = divided.asked(cloud.size());
    AskedVertices levelled = asked;
    for (const float each : level_areas(levelled, divided.territories, divided.samples.size()))
        EXPECT_NEAR(each, 0.88, 0.05);
    EXPECT_EQ(levelled.area, asked.area);
}

// A part of the cloud may have samples that were added alone.
TEST(TerritoryAreas, WithoutABaseSampleAreWhatStarsSay) {
    std::vector<float> positions = test::shape_positions(Shape::sphere, 3000);
    const std::size_t base_part = positions.size();
    for (std::size_t i = 0; i < base_part; ++i)
        positions.push_back(positions[i] + (i % 3 == 0 ? 9.0F : 0.0F));
    const Cloud cloud = test::cloud_of(positions);
    Divided divided(cloud, 60);
    Index beyond = 0;
    while (cloud.at(beyond).x() < 5) ++beyond;
    std::vector<Index> base;
    for (const Index v : divided.samples)
        if (cloud.at(v).x() < 5) base.push_back(v);
    divided.samples = base;
    divided.territories = territories_of_base(
        flood(cloud.graph, cloud.lengths, base, divided.machine.workers, divided.machine.progress),
        base.size(), cloud.graph, divided.machine.workers);
    AskedVertices asked = divided.ask(1000, 2, divided.machine.workers);
    level_areas(asked, divided.territories, base.size());
    for (std::size_t k = 0; k < asked.vertex.size(); ++k) {
        EXPECT_GT(asked.area[k], 0);
        if (cloud.at(asked.vertex[k]).x() > 5) {
            EXPECT_EQ(asked.area[k], asked.star[k]);
        }
    }
    divided.add({beyond});
    const std::vector<double> area = divided.areas(asked);
    EXPECT_NEAR(area.back(), std::accumulate(area.begin(), area.end() - 1, 0.0), 0.2 * area.back());
}

TEST(TerritoryAreas, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 5000));
    Divided divided(cloud, 60);
    const AskedVertices asked = divided.asked(60);
    const std::vector<double> area = divided.areas(asked);
    for (const unsigned threads : {1U, 5U}) {
        Workers workers(threads);
        const AskedVertices again = divided.ask(16 * 60, 1, workers);
        EXPECT_EQ(again.vertex, asked.vertex);
        EXPECT_EQ(again.area, asked.area);
        EXPECT_EQ(territory_areas(again, divided.territories, divided.samples.size(), workers), area);
    }
}

TEST(TerritoryAreas, OfNoSamplesAreNone) {
    Machine machine;
    AskedVertices asked;
    EXPECT_TRUE(level_areas(asked, {}, 0).empty());
    EXPECT_TRUE(territory_areas(asked, {}, 0, machine.workers).empty());
}

} // namespace
} // namespace knead

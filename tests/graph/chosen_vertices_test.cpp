#include "graph/chosen_vertices.h"

#include "graph/clouds.h"

#include <algorithm>
#include <cmath>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

ChosenVertices choose(const Cloud& cloud, std::size_t count, unsigned threads = 2) {
    Machine machine(threads);
    return choose_by_area(cloud.graph, cloud.lengths, {}, count, machine.workers);
}

// Along z a bar that becomes twenty times denser: of both halves as many are chosen, though one has three
// times as many points, and they stand for all that there are.
TEST(ChosenVertices, AreSpreadOverTheSurfaceHoweverDenseItIs) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::bar, 40'000, 20));
    std::size_t upper = 0;
    for (std::size_t v = 0; v < cloud.size(); ++v) upper += cloud.at(v).z() > 0 ? 1 : 0;
    const std::size_t denser = std::max(upper, cloud.size() - upper);
    ASSERT_GT(denser, 3 * (cloud.size() - denser));

    const ChosenVertices chosen = choose(cloud, 2000);
    EXPECT_FALSE(chosen.all);
    EXPECT_NEAR(static_cast<double>(chosen.vertex.size()), 2000, 20);
    EXPECT_TRUE(std::ranges::is_sorted(chosen.vertex));
    ASSERT_EQ(chosen.each.size(), chosen.vertex.size());
    double above = 0, for_above = 0, for_all = 0;
    for (std::size_t k = 0; k < chosen.vertex.size(); ++k) {
        const bool is_above = cloud.at(chosen.vertex[k]).z() > 0;
        above += is_above ? 1 : 0;
        for_above += is_above ? chosen.each[k] : 0;
        for_all += chosen.each[k];
        EXPECT_GE(chosen.each[k], 1);
    }
    EXPECT_NEAR(above, 1000, 100);
    EXPECT_NEAR(for_all, static_cast<double>(cloud.size()), 0.05 * static_cast<double>(cloud.size()));
    EXPECT_NEAR(for_above, static_cast<double>(upper), 0.1 * static_cast<double>(upper));
}

// On a grid a square is a square: one of so many along the order, each for as many.
TEST(ChosenVertices, OfEvenPointsAreOneOfSoMany) {
    const Cloud grid = test::cloud_of(test::grid_positions(64, 64), 4);
    Cloud even = grid;
    std::ranges::fill(even.lengths, std::uint8_t{16}); // at rims, too
    const ChosenVertices chosen = choose(even, 512);
    EXPECT_NEAR(static_cast<double>(chosen.vertex.size()), 512, 1);
    for (std::size_t k = 0; k < chosen.vertex.size(); ++k) {
        EXPECT_NEAR(chosen.vertex[k], 8.0 * static_cast<double>(k) + 7, 1);
        EXPECT_DOUBLE_EQ(chosen.each[k], 8);
    }
}

// One link may span more than a share of all: its ends are there, once.
TEST(ChosenVertices, ThatStandForMuchAreChosenOnce) {
    Cloud cloud = test::cloud_of(test::grid_positions(40, 40), 4);
    std::ranges::fill(cloud.lengths, std::uint8_t{1});
    const Index far = 777;
    for (Index link = cloud.graph.first[far]; link < cloud.graph.first[far + 1]; ++link)
        cloud.lengths[link] = 255;
    const ChosenVertices chosen = choose(cloud, 400);
    const auto found = std::ranges::equal_range(chosen.vertex, far);
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(chosen.each[static_cast<std::size_t>(found.begin() - chosen.vertex.begin())], 1);
}

// One in twenty has a hundred times the area of the others, more than its share: these are all there, and the
// rest is shared among the others.
TEST(ChosenVertices, AreAsManyAsAreAskedForWhereSomeStandForMuch) {
    Cloud cloud = test::cloud_of(test::grid_positions(100, 100), 4);
    std::ranges::fill(cloud.lengths, std::uint8_t{10});
    for (Index v = 0; v < cloud.size(); v += 20)
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link)
            cloud.lengths[link] = 100;
    const ChosenVertices chosen = choose(cloud, 2000);
    EXPECT_NEAR(static_cast<double>(chosen.vertex.size()), 2000, 100);
    std::size_t large = 0;
    double all = 0;
    for (std::size_t k = 0; k < chosen.vertex.size(); ++k) {
        large += chosen.vertex[k] % 20 == 0 ? 1 : 0;
        all += chosen.each[k];
    }
    EXPECT_EQ(large, 500U);
    EXPECT_NEAR(all, 10'000, 500);
}

TEST(ChosenVertices, AreNoOutliersThatHang) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 5000));
    Machine machine;
    std::vector<std::uint8_t> hanging(cloud.size());
    for (std::size_t v = 0; v < cloud.size(); ++v) hanging[v] = v % 3 == 0 ? 0 : 1;
    for (const std::size_t enough : {std::size_t{2000}, cloud.size()}) {
        const ChosenVertices all =
            choose_by_area(cloud.graph, cloud.lengths, hanging, enough, machine.workers);
        EXPECT_TRUE(all.all);
        ASSERT_EQ(all.vertex.size(), (cloud.size() + 2) / 3);
        for (std::size_t k = 0; k < all.vertex.size(); ++k) {
            EXPECT_EQ(all.vertex[k], 3 * k);
            EXPECT_EQ(all.each[k], 1);
        }
    }
    const ChosenVertices few = choose_by_area(cloud.graph, cloud.lengths, hanging, 300, machine.workers);
    EXPECT_FALSE(few.all);
    EXPECT_GT(few.vertex.size(), 250U);
    for (const Index v : few.vertex) EXPECT_EQ(v % 3, 0U);
}

TEST(ChosenVertices, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 20'000));
    const ChosenVertices chosen = choose(cloud, 1500);
    for (const unsigned threads : {1U, 5U}) {
        const ChosenVertices again = choose(cloud, 1500, threads);
        EXPECT_EQ(again.vertex, chosen.vertex);
        EXPECT_EQ(again.each, chosen.each);
    }
}

TEST(ChosenVertices, ByNumberAreEvenlyAlongTheOrder) {
    const ChosenVertices some = choose_by_number(1000, 10);
    EXPECT_FALSE(some.all);
    ASSERT_EQ(some.vertex.size(), 10U);
    for (Index k = 0; k < 10; ++k) EXPECT_EQ(some.vertex[k], 100 * k);
    EXPECT_EQ(some.each, std::vector<double>(10, 100.0));
    EXPECT_TRUE(choose_by_number(10, 1000).all);
    EXPECT_TRUE(choose_by_number(0, 5).vertex.empty());
    EXPECT_TRUE(choose_by_number(5, 0).vertex.empty());
}

TEST(ChosenVertices, OfNoneAreNone) {
    const Cloud cloud = test::cloud_of(test::grid_positions(8, 8), 4);
    EXPECT_TRUE(choose(cloud, 0).vertex.empty());
    Machine machine;
    const std::vector<std::uint8_t> hanging(cloud.size(), 1);
    EXPECT_TRUE(choose_by_area(cloud.graph, cloud.lengths, hanging, 9, machine.workers).vertex.empty());
    EXPECT_TRUE(choose_by_area({}, {}, {}, 9, machine.workers).vertex.empty());
}

} // namespace
} // namespace knead

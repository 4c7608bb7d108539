#include "graph/clouds.h"
#include "graph/nearest_lists.h"
#include "graph/scrambled.h"

#include <cmath>
#include <limits>
#include <utility>

#include <tuple>

namespace knead {
namespace {

using test::Machine;

// As the vertices of a cloud are: in Morton order, each position once.
std::vector<float> ordered(const std::vector<float>& positions) {
    Machine machine;
    const PointOrder order = order_points(positions, machine.workers, machine.progress);
    std::vector<float> within(3 * order.points());
    gather(order, positions, 3, within, machine.workers);
    return vertex_positions(order, within, machine.workers);
}

std::vector<Index> found(const std::vector<float>& positions, std::size_t k, std::size_t most_a_tree,
                         unsigned threads = 2) {
    Machine machine(threads);
    return nearest_lists(positions, k, machine.workers, machine.progress, most_a_tree);
}

// Every vertex against every other.
std::vector<Index> plain_lists(const std::vector<float>& positions, std::size_t k) {
    const std::size_t vertices = positions.size() / 3;
    std::vector<Index> lists;
    for (std::size_t v = 0; v < vertices; ++v) {
        std::vector<std::tuple<double, std::uint64_t, Index>> others;
        for (Index u = 0; u < vertices; ++u)
            if (u != v)
                others.emplace_back((point_at(positions, u) - point_at(positions, v)).squaredNorm(),
                                    scrambled(u), u);
        std::ranges::partial_sort(others, others.begin() + static_cast<std::ptrdiff_t>(k));
        for (std::size_t i = 0; i < k; ++i) lists.push_back(std::get<2>(others[i]));
    }
    return lists;
}

void expect_plain_lists(const std::vector<float>& positions, const std::string& name) {
    for (const std::size_t k : {1U, 6U, 20U}) {
        const std::vector<Index> plain = plain_lists(positions, k);
        for (const std::size_t most_a_tree : {std::size_t{1}, std::size_t{5}, std::size_t{64}, usual_tree})
            EXPECT_EQ(found(positions, k, most_a_tree), plain)
                << name << ", k = " << k << ", trees of at most " << most_a_tree;
    }
}

std::vector<float> times(std::vector<float> positions, float factor) {
    for (float& value : positions) value *= factor;
    return positions;
}

TEST(NearestLists, AreThoseOfASearchOfAllHoweverTheTreesAreCut) {
    expect_plain_lists(ordered(test::random_positions(500, 1)), "a solid");
    expect_plain_lists(test::random_positions(300, 2), "a solid in no order");
    expect_plain_lists(ordered(test::shape_positions(Shape::creature, 600)), "a surface");
    expect_plain_lists(ordered(test::random_positions(300, 3, Vec3d(1e6, -1e6, 1e6))), "far from the origin");
}

TEST(NearestLists, TakeTheLowestScrambledNumbersOfEquallyNearOnes) {
    expect_plain_lists(ordered(test::grid_positions(20, 20)), "a square lattice");
    std::vector<float> cube;
    for (int x = 0; x < 8; ++x)
        for (int y = 0; y < 8; ++y)
            for (int z = 0; z < 8; ++z) test::append(cube, Vec3d(x, y, z));
    expect_plain_lists(ordered(cube), "a cubic lattice");
}

TEST(NearestLists, AreRightOnLinesAndInClusters) {
    std::vector<float> line, spread_out;
    for (int i = 0; i < 300; ++i) test::append(line, Vec3d(i + 0.3 * std::sin(i), 0, 0));
    for (int i = 0; i < 200; ++i) test::append(spread_out, Vec3d(std::ldexp(1.0, i - 100), 0, 1));
    expect_plain_lists(ordered(line), "a line");
    expect_plain_lists(ordered(spread_out), "a line whose gaps grow by twice and twice");
    std::vector<float> clusters = times(test::random_positions(200, 4), 1e-4F);
    for (const float value : test::random_positions(200, 5, Vec3d(1e4, 0, 0))) clusters.push_back(value);
    expect_plain_lists(ordered(clusters), "a small cluster and a large one far away");
}

TEST(NearestLists, AreRightWithTheSmallestAndTheLargestNumbers) {
    // Squares of either would be zero or infinite in float, and the sum of two of the largest infinite.
    std::vector<float> tiny{1, 0, 0};
    for (const float value : times(test::random_positions(100, 6), 1e-25F)) tiny.push_back(value);
    expect_plain_lists(ordered(tiny), "distances of 1e-25 beside a coordinate of 1");
    expect_plain_lists(ordered(times(test::random_positions(200, 7), std::numeric_limits<float>::max())),
                       "as large as floats are");
    expect_plain_lists(
        ordered(times(test::random_positions(200, 8, Vec3d(3, 3, 3)), std::numeric_limits<float>::max() / 4)),
        "all near the largest float");
}

TEST(NearestLists, AreTheSameForAnyNumberOfThreadsAndTrees) {
    // As the program cuts them: several trees, several runs in each, borders within the surface.
    const std::vector<float> positions = ordered(test::shape_positions(Shape::knot, 150'000));
    ASSERT_GT(positions.size() / 3, 2 * usual_tree);
    const std::vector<Index> expected = found(positions, 6, positions.size(), 1);
    for (const unsigned threads : {1U, 2U, 4U}) EXPECT_EQ(found(positions, 6, usual_tree, threads), expected);
}

} // namespace
} // namespace knead

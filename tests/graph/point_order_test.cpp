#include "graph/clouds.h"

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <map>

namespace knead {
namespace {

using test::Machine;

PointOrder ordered(const std::vector<float>& positions, unsigned threads = 2) {
    Machine machine(threads);
    return order_points(positions, machine.workers, machine.progress);
}

// What holds of every order, whatever the points.
void expect_consistent(const PointOrder& order, std::span<const float> positions) {
    ASSERT_EQ(order.vertex.size(), order.points());
    ASSERT_EQ(order.first_point.size(), order.vertices() + 1);
    EXPECT_EQ(order.first_point[order.vertices()], order.points());
    std::vector<std::uint64_t> codes;
    for (const Index i : order.file_index) codes.push_back(morton_code(point_at(positions, i), order.cube));
    EXPECT_TRUE(std::ranges::is_sorted(codes));
    for (std::size_t v = 0; v < order.vertices(); ++v) {
        ASSERT_LT(order.first_point[v], order.first_point[v + 1]);
        for (Index i = order.first_point[v]; i < order.first_point[v + 1]; ++i) ASSERT_EQ(order.vertex[i], v);
    }
}

TEST(PointOrder, IsAPermutationOfTheFinitePoints) {
    std::vector<float> positions = test::random_positions(5000, 1);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    positions[3 * 17] = nan;
    positions[3 * 1234 + 1] = infinity;
    positions[3 * 4999 + 2] = -infinity;
    const PointOrder order = ordered(positions);
    expect_consistent(order, positions);

    std::vector<Index> sorted = order.file_index;
    std::ranges::sort(sorted);
    std::vector<Index> expected;
    for (Index i = 0; i < 5000; ++i)
        if (i != 17 && i != 1234 && i != 4999) expected.push_back(i);
    EXPECT_EQ(sorted, expected);
}

TEST(PointOrder, MakesDuplicatesOneVertexWithTheLowestFileIndexFirst) {
    std::vector<float> positions = test::random_positions(1000, 2);
    const std::vector<float> once = positions;
    positions.insert(positions.end(), once.begin(), once.begin() + 3 * 600);
    positions.insert(positions.end(), once.begin(), once.begin() + 3 * 200);
    const PointOrder order = ordered(positions);
    expect_consistent(order, positions);
    EXPECT_EQ(order.vertices(), 1000U);
    EXPECT_EQ(order.points(), 1800U);

    std::map<std::array<float, 3>, std::vector<Index>> by_position; // file indices, as ordered
    std::map<std::array<float, 3>, Index> vertex_of;
    for (std::size_t i = 0; i < order.points(); ++i) {
        const float* p = positions.data() + 3 * std::size_t{order.file_index[i]};
        by_position[{p[0], p[1], p[2]}].push_back(order.file_index[i]);
        const auto [found, isnew] = vertex_of.insert({{p[0], p[1], p[2]}, order.vertex[i]});
        EXPECT_EQ(found->second, order.vertex[i]);
    }
    for (const auto& [position, indices] : by_position) EXPECT_TRUE(std::ranges::is_sorted(indices));
}

TEST(PointOrder, TakesBothZerosForOnePosition) {
    const PointOrder order = ordered({0.0F, 1, 2, -0.0F, 1, 2, 5, 5, 5});
    EXPECT_EQ(order.vertices(), 2U);
}

TEST(PointOrder, IsTheSameForAnyNumberOfThreads) {
    // More than one chunk of work a thread, and many points in one cell of the curve.
    std::vector<float> positions = test::random_positions(60000, 4);
    for (std::size_t i = 0; i < 3 * 2000; ++i) positions[i] *= 1e-7F;
    const PointOrder one = ordered(positions, 1);
    expect_consistent(one, positions);
    for (const unsigned threads : {2U, 5U}) {
        const PointOrder more = ordered(positions, threads);
        EXPECT_EQ(more.file_index, one.file_index);
        EXPECT_EQ(more.vertex, one.vertex);
        EXPECT_EQ(more.first_point, one.first_point);
    }
}

TEST(PointOrder, AcceptsNoPointOnePointAndOnlyBadOnes) {
    const PointOrder none = ordered({});
    EXPECT_EQ(none.points(), 0U);
    EXPECT_EQ(none.vertices(), 0U);
    expect_consistent(none, {});
    const PointOrder one = ordered({3, -4, 5});
    EXPECT_EQ(one.file_index, std::vector<Index>{0});
    EXPECT_EQ(one.vertices(), 1U);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> not_finite{nan, 0, 0, 0, nan, 0};
    const PointOrder bad = ordered(not_finite);
    EXPECT_EQ(bad.points(), 0U);
    expect_consistent(bad, not_finite);
}

TEST(PointOrder, MakesEqualPointsOneVertex) {
    std::vector<float> positions;
    for (int i = 0; i < 100; ++i) test::append(positions, Vec3d(1, 2, 3));
    const PointOrder order = ordered(positions);
    expect_consistent(order, positions);
    EXPECT_EQ(order.vertices(), 1U);
    EXPECT_TRUE(std::ranges::is_sorted(order.file_index));
    EXPECT_EQ(order.points(), 100U);
}

TEST(PointOrder, DoesNotDependOnTheUnit) {
    const std::vector<float> positions = test::random_positions(2000, 5);
    const PointOrder expected = ordered(positions);
    for (const int exponent : {-100, 100, 126}) { // a power of two rounds nothing
        std::vector<float> scaled = positions;
        for (float& value : scaled) value = std::ldexp(value, exponent);
        EXPECT_EQ(ordered(scaled).file_index, expected.file_index) << "scaled by 2^" << exponent;
    }
}

TEST(PointOrder, AcceptsTheLargestAndTheSmallestNumbers) {
    const float largest = std::numeric_limits<float>::max();
    const float smallest = std::numeric_limits<float>::denorm_min();
    const std::vector<float> far{largest, largest, largest, -largest, -largest, -largest, smallest, 0, 0};
    const PointOrder wide = ordered(far);
    expect_consistent(wide, far);
    EXPECT_EQ(wide.vertices(), 3U);
    const std::vector<float> near{0, 0, 0, smallest, 0, 0, 0, smallest, 0};
    const PointOrder narrow = ordered(near);
    expect_consistent(narrow, near);
    EXPECT_EQ(narrow.vertices(), 3U);
}

TEST(PointOrder, KeepsNeighboursInSpaceTogether) {
    // The reason for the order: consecutive points of a shuffled cloud are half a cube apart, along the curve
    // some spacings. A tenth of the shuffled distance leaves both far from the threshold.
    const std::vector<float> positions = test::random_positions(8000, 6);
    const PointOrder order = ordered(positions);
    const auto at = [&](std::size_t i) { return Eigen::Map<const Vec3f>(positions.data() + 3 * i); };
    double along_file = 0;
    double along_curve = 0;
    for (std::size_t i = 1; i < order.points(); ++i) {
        along_file += static_cast<double>((at(i) - at(i - 1)).norm());
        along_curve += static_cast<double>((at(order.file_index[i]) - at(order.file_index[i - 1])).norm());
    }
    EXPECT_LT(along_curve, 0.12 * along_file);
}

TEST(PointOrder, ScatterUndoesGather) {
    std::vector<float> positions = test::random_positions(3000, 7);
    positions[3 * 5] = std::numeric_limits<float>::quiet_NaN();
    const PointOrder order = ordered(positions);
    Machine machine;
    for (const std::size_t width : {std::size_t{1}, std::size_t{3}}) {
        std::vector<float> values(3000 * width);
        for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i);
        std::vector<float> within(order.points() * width);
        gather(order, values, width, within, machine.workers);
        EXPECT_EQ(within[0], values[order.file_index[0] * width]);
        std::vector<float> back(values.size(), -7);
        scatter(order, within, width, back, machine.workers);
        for (std::size_t i = 0; i < values.size(); ++i)
            EXPECT_EQ(back[i], i / width == 5 ? -7 : values[i]); // the point left out keeps its value
    }
}

TEST(PointOrder, GivesEachVertexItsPosition) {
    std::vector<float> positions = test::random_positions(500, 8);
    const std::vector<float> once = positions;
    positions.insert(positions.end(), once.begin(), once.end());
    const PointOrder order = ordered(positions);
    Machine machine;
    std::vector<float> within(positions.size());
    gather(order, positions, 3, within, machine.workers);
    const std::vector<float> vertices = vertex_positions(order, within, machine.workers);
    ASSERT_EQ(vertices.size(), 3 * order.vertices());
    for (std::size_t i = 0; i < order.points(); ++i)
        for (std::size_t axis = 0; axis < 3; ++axis)
            EXPECT_EQ(vertices[3 * order.vertex[i] + axis], within[3 * i + axis]);
}

} // namespace
} // namespace knead

// Bridges between components, and outliers that hang.

#include "graph/bridges.h"

#include "graph/clouds.h"
#include "graph/dust.h"
#include "graph/outliers.h"
#include "graph/symmetric_graph.h"

#include <cmath>
#include <set>
#include <utility>

namespace knead {
namespace {

using namespace test;

JoinedGraph bridged_of(const Cloud& cloud, unsigned threads = 2) {
    Machine machine(threads);
    return bridged(cloud.graph, cloud.positions, machine.workers, machine.progress);
}

std::optional<JoinedGraph> hung_of(const Cloud& cloud, unsigned threads = 2) {
    Machine machine(threads);
    return with_hanging_outliers(cloud.graph, cloud.positions, machine.workers, machine.progress);
}

// Two square plates of unit spacing, one above the other.
std::vector<float> plates(double gap, double spacing_above = 1) {
    std::vector<float> positions = grid_positions(20, 20);
    const int count = static_cast<int>(20 / spacing_above);
    for (int x = 0; x < count; ++x)
        for (int y = 0; y < count; ++y)
            append(positions, Vec3d(x * spacing_above + 0.1, y * spacing_above + 0.1, gap));
    return positions;
}

std::size_t parts(const Graph& graph) {
    return test::components_of(graph).size.size();
}

TEST(Bridges, JoinPlatesThatAreNearAndNoOthers) {
    for (const double gap : {2.3, 5.0}) {
        const Cloud cloud = cloud_of(plates(gap));
        ASSERT_EQ(cloud.components.size.size(), 2U);
        const JoinedGraph joined = bridged_of(cloud);
        EXPECT_EQ(parts(joined.graph), 1U) << gap;
        EXPECT_GE(joined.joints, 400U) << "they are not sewn together all along";
        EXPECT_EQ(joined.outliers, 0U);
    }
    const Cloud far = cloud_of(plates(20));
    EXPECT_TRUE(same_graph(bridged_of(far).graph, far.graph));
}

TEST(Bridges, JudgeTheGapByTheDenserSide) {
    const Cloud even = cloud_of(plates(6));
    EXPECT_EQ(parts(bridged_of(even).graph), 1U);
    const Cloud dense_above = cloud_of(plates(6, 0.45)); // 13 of its spacings
    ASSERT_EQ(dense_above.components.size.size(), 2U);
    EXPECT_EQ(parts(bridged_of(dense_above).graph), 2U);
}

TEST(Bridges, OfPartsThatAreAsLargeDoNotDependOnTheirOrder) {
    const std::vector<float> one = plates(2.3);
    std::vector<float> other(one.begin() + static_cast<std::ptrdiff_t>(one.size() / 2), one.end());
    other.insert(other.end(), one.begin(), one.begin() + static_cast<std::ptrdiff_t>(one.size() / 2));
    const auto links = [](const std::vector<float>& positions) {
        const Cloud cloud = test::cloud_of(positions);
        std::set<std::pair<float, float>> found; // by heights and places that tell them apart
        const Graph graph = bridged_of(cloud).graph;
        for (Index v = 0; v < graph.size(); ++v)
            for (const Index u : graph.row(v))
                if (cloud.positions[3 * v + 2] < cloud.positions[3 * u + 2])
                    found.insert({40 * cloud.positions[3 * v] + cloud.positions[3 * v + 1],
                                  40 * cloud.positions[3 * u] + cloud.positions[3 * u + 1]});
        return found;
    };
    EXPECT_FALSE(links(one).empty());
    EXPECT_EQ(links(one), links(other));
}

TEST(Bridges, JoinWhatEachHasANearerPartBeside) {
    std::vector<float> positions;
    for (const double height : {0.0, 3.0, 8.0, 11.0}) // the gap of 5 is nobody's nearest
        for (int x = 0; x < 20; ++x)
            for (int y = 0; y < 20; ++y) append(positions, Vec3d(x, y, height));
    const Cloud cloud = cloud_of(positions);
    ASSERT_EQ(cloud.components.size.size(), 4U);
    EXPECT_EQ(parts(bridged_of(cloud).graph), 1U);
}

TEST(Bridges, ReachPastAPartThatReachesNobody) {
    std::vector<float> positions = plates(7);
    for (int x = 0; x < 380; ++x) // dense, in the middle of the gap
        for (int y = 0; y < 20; ++y) append(positions, Vec3d(x * 0.05, 9 + y * 0.05, 3.5));
    const Cloud cloud = cloud_of(positions);
    ASSERT_EQ(cloud.components.size.size(), 3U);
    const JoinedGraph joined = bridged_of(cloud);
    EXPECT_EQ(parts(joined.graph), 2U);
    EXPECT_GE(joined.joints, 400U) << "all along";
}

TEST(Bridges, LinkNothingWithinAComponent) {
    std::vector<NamedCloud> clouds = several_clouds();
    clouds.push_back({"plates", cloud_of(plates(2.5))});
    clouds.push_back({"large knot", cloud_of(shape_positions(Shape::knot, 20000))});
    for (const auto& [name, cloud] : clouds) {
        const JoinedGraph joined = bridged_of(cloud);
        expect_well_formed(joined.graph);
        for (Index v = 0; v < cloud.size(); ++v) {
            for (const Index u : joined.graph.row(v)) {
                if (joined.hanging[v] || joined.hanging[u] || find_link(cloud.graph, v, u)) continue;
                ASSERT_NE(cloud.components.component[v], cloud.components.component[u]) << name;
            }
        }
    }
}

TEST(Bridges, LeaveTheLimbsOfAKnotAlone) {
    const Cloud knot = cloud_of(shape_positions(Shape::knot, 20000));
    EXPECT_TRUE(same_graph(bridged_of(knot).graph, knot.graph));
}

TEST(Bridges, AreTheSameWhateverTheNumberOfWorkers) {
    std::vector<float> positions = plates(3);
    const std::vector<float> dust = random_positions(60, 5, {10, 10, 9});
    positions.insert(positions.end(), dust.begin(), dust.end());
    const Cloud cloud = cloud_of(positions);
    const JoinedGraph one = bridged_of(cloud, 1), three = bridged_of(cloud, 3);
    EXPECT_TRUE(same_graph(one.graph, three.graph));
    EXPECT_EQ(one.hanging, three.hanging);
}

// --- Outliers

TEST(Outliers, BetweenTwoSurfacesTieThemNotWhereThereAreBridges) {
    std::vector<float> positions = plates(24);
    for (const double x : {8.0, 10.5, 13.0}) append(positions, Vec3d(x, 9, 12));
    const Cloud cloud = cloud_of(positions);
    ASSERT_EQ(cloud.components.size.size(), 1U) << "there is nothing to be taken apart";
    const JoinedGraph joined = bridged_of(cloud);
    EXPECT_EQ(joined.outliers, 3U);
    EXPECT_EQ(parts(joined.graph), 2U);
    const JoinedGraph hung = hung_of(cloud).value();
    EXPECT_EQ(hung.outliers, 3U);
    EXPECT_EQ(hung.joints, 1U);
    EXPECT_EQ(parts(hung.graph), 1U) << "what was together came apart";
}

PointCloud dusty_knot(Machine& machine) {
    ShapeOptions options;
    options.points = 20000;
    options.outliers = 0.02;
    return make_shape(Shape::knot, options, machine.workers, machine.progress);
}

TEST(Outliers, HangOnOneVertexThatIsNone) {
    Machine machine;
    const Cloud cloud = cloud_of(dusty_knot(machine).positions);
    for (const JoinedGraph& joined : {bridged_of(cloud), hung_of(cloud).value()}) {
        expect_well_formed(joined.graph);
        EXPECT_GT(joined.outliers, 280U); // of 400, some of them near the surface
        EXPECT_LT(joined.outliers, 420U);
        std::size_t hanging = 0;
        for (std::size_t v = 0; v < cloud.size(); ++v) {
            if (!joined.hanging[v]) continue;
            ++hanging;
            ASSERT_EQ(joined.graph.row(v).size(), 1U);
            ASSERT_FALSE(joined.hanging[joined.graph.row(v).front()]);
        }
        EXPECT_EQ(hanging, joined.outliers);
        const Components components = test::components_of(joined.graph);
        EXPECT_GT(*std::ranges::max_element(components.size), 19900U);
    }
}

TEST(Outliers, HangWithoutBridgesAndPartsStayWhatTheyWere) {
    Machine machine;
    std::vector<float> positions = dusty_knot(machine).positions;
    const std::vector<float> far = random_positions(40, 7, {0.1, 0.1, 0.1});
    for (std::size_t i = 0; i < far.size(); ++i) positions.push_back(far[i] + (i % 3 == 0 ? 9 : 0));
    const Cloud cloud = cloud_of(positions);
    ASSERT_GT(cloud.components.size.size(), 1U);
    const JoinedGraph hung = hung_of(cloud).value();
    EXPECT_EQ(test::components_of(hung.graph).component, cloud.components.component);
    std::size_t ties = 0;
    for (Index v = 0; v < cloud.size(); ++v)
        for (const Index u : hung.graph.row(v))
            ties += hung.hanging[v] || hung.hanging[u] || find_link(cloud.graph, v, u) ? 0 : 1;
    EXPECT_EQ(ties, 2 * hung.joints);
    const JoinedGraph alone = hung_of(cloud, 1).value();
    EXPECT_TRUE(same_graph(alone.graph, hung.graph));
    EXPECT_EQ(alone.hanging, hung.hanging);
}

TEST(Outliers, LeaveOneTieHoweverManyThereWere) {
    std::vector<float> positions = plates(14);
    for (const double y : {1.0, 18.0})
        for (const double x : {8.0, 10.5, 13.0}) append(positions, Vec3d(x, y, 7));
    const Cloud cloud = cloud_of(positions);
    ASSERT_EQ(cloud.components.size.size(), 1U);
    const JoinedGraph hung = hung_of(cloud).value();
    EXPECT_EQ(hung.outliers, 6U);
    EXPECT_EQ(hung.joints, 1U);
    EXPECT_EQ(parts(hung.graph), 1U);
}

TEST(Outliers, AreNotFoundWhereThereAreNone) {
    EXPECT_FALSE(hung_of(cloud_of(shape_positions(Shape::knot, 20000))));
    EXPECT_FALSE(hung_of(cloud_of(plates(5))));
    EXPECT_FALSE(hung_of(cloud_of({})));
}

TEST(Outliers, TieThePiecesBesideThemToTheLargest) {
    // Pieces of 2, 3 and 2 vertices in a row, and one outlier amid them.
    const std::vector<float> positions{0, 0, 0, 1, 0, 0, 4,  0, 0, 5, 0, 0,
                                       6, 0, 0, 9, 0, 0, 10, 0, 0, 5, 5, 0};
    const std::pair<Index, Index> links[] = {{0, 1}, {2, 3}, {3, 4}, {5, 6}, {7, 1}, {7, 3}, {7, 5}};
    Graph graph;
    graph.first.assign(9, 0);
    Machine machine;
    graph = with_edges(graph, links, machine.workers);
    const Components pieces{{{0, 0, 1, 1, 1, 2, 2, 3}, 4}, {2, 3, 2, 1}};
    const std::vector<std::uint8_t> outlier{0, 0, 0, 0, 0, 0, 0, 1};
    const Dust dust = gather_dust(graph, pieces, outlier, positions);
    const std::vector<std::pair<Index, Index>> expected{{1, 3}, {5, 3}};
    EXPECT_EQ(dust.ties, expected);
    EXPECT_EQ(dust.hanging, outlier);
}

// Points of a thread lie on one plane with the two that they are linked to, wherever these are.
TEST(Outliers, OfFewLinksAreNoSurface) {
    Machine machine;
    Cloud cloud = cloud_of(grid_positions(20, 20));
    std::vector<std::pair<Index, Index>> thread;
    for (int i = 0; i < 9; ++i) {
        const auto next = static_cast<Index>(cloud.size());
        append(cloud.positions, Vec3d(3 * i, 10 + i % 2, 12));
        cloud.graph.first.push_back(cloud.graph.first.back());
        if (i > 0) thread.emplace_back(next - 1, next);
    }
    cloud.graph = with_edges(cloud.graph, thread, machine.workers);
    const Spacings spacings = find_spacings(cloud.graph, cloud.positions, machine.workers);
    const auto hanging = find_outliers(cloud.graph, cloud.positions, spacings, machine.workers);
    EXPECT_EQ(std::accumulate(hanging.begin(), hanging.end(), 0), 9);
    EXPECT_EQ(std::accumulate(hanging.end() - 9, hanging.end(), 0), 9);
}

// A scan is sparse where the scanner saw it from afar.
TEST(Outliers, AreNoSparseStripWhereADenseSurfaceEnds) {
    std::vector<float> positions = grid_positions(100, 100);
    constexpr int rows = 7, columns = 25;
    for (int row = 1; row <= rows; ++row)
        for (int column = 0; column < columns; ++column)
            append(positions, Vec3d(99 + 4 * row, 4 * column, 0));
    const Cloud cloud = cloud_of(positions);
    ASSERT_EQ(cloud.components.size.size(), 1U);
    // The row at the seam may hang; the others are of the surface.
    EXPECT_LE(bridged_of(cloud).outliers, columns);
    EXPECT_EQ(parts(bridged_of(cloud).graph), 1U);
}

// Units are powers of two, so that links, spacings and limits differ by them alone.
TEST(Outliers, AreTheSameInUnitsOfWhichFloatsHoldNoSquares) {
    Machine machine;
    const Cloud cloud = cloud_of(dusty_knot(machine).positions);
    const JoinedGraph expected = hung_of(cloud).value();
    const Spacings spacings = find_spacings(cloud.graph, cloud.positions, machine.workers);
    for (const int exponent : {-90, -70, 30, 65, 80}) {
        std::vector<float> scaled = cloud.positions;
        for (float& coordinate : scaled) coordinate = std::ldexp(coordinate, exponent);
        const Spacings found = find_spacings(cloud.graph, scaled, machine.workers);
        for (std::size_t v = 0; v < cloud.size(); ++v) // doubles round elsewhere
            ASSERT_FLOAT_EQ(std::ldexp(found.own[v], -exponent), spacings.own[v]) << exponent;
        const auto hanging = find_outliers(cloud.graph, scaled, found, machine.workers);
        EXPECT_EQ(std::vector<std::uint8_t>(expected.hanging.begin(), expected.hanging.end()), hanging)
            << exponent;
    }
}

TEST(Outliers, AreNeverAll) {
    for (const std::size_t points : {0U, 1U, 2U, 3U, 6U, 8U, 40U}) {
        const Cloud cloud = cloud_of(random_positions(points, 11));
        const JoinedGraph joined = bridged_of(cloud);
        expect_well_formed(joined.graph);
        EXPECT_EQ(joined.graph.size(), points);
        if (points > 0) {
            EXPECT_LT(joined.outliers, points);
        }
        if (const auto hung = hung_of(cloud)) {
            expect_well_formed(hung->graph);
            EXPECT_LT(hung->outliers, points);
        }
    }
}

} // namespace
} // namespace knead

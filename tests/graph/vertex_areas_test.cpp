#include "graph/vertex_areas.h"

#include "graph/clouds.h"

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

AskedVertices ask(const Cloud& cloud, std::size_t count, unsigned threads = 2,
                  const std::vector<std::uint8_t>& hanging = {}) {
    Machine machine(threads);
    return ask_vertices(cloud.graph, cloud.positions, Numbering::as_they_stand(cloud.size()), hanging,
                        choose_by_number(cloud.size(), count), 1, machine.workers);
}

double sum_of(const std::vector<double>& amounts) {
    return std::accumulate(amounts.begin(), amounts.end(), 0.0);
}

// Each by up to so much along each axis.
std::vector<float> moved(std::vector<float> positions, double way) {
    std::mt19937 random(3);
    for (std::size_t i = 0; i < positions.size(); i += 3) {
        const Vec3d p = point_at(positions, i / 3) + way * test::random_vector(random);
        for (std::size_t axis = 0; axis < 3; ++axis)
            positions[i + axis] = static_cast<float>(p[static_cast<Eigen::Index>(axis)]);
    }
    return positions;
}

// Area is area, whether points keep apart, lie at random or beside the surface. What links tell is not.
TEST(VertexAreas, AreTheSurfaceHoweverPointsLieOnIt) {
    constexpr double sphere = 4 * std::numbers::pi;
    const double spacing = std::sqrt(sphere / 4000);
    const std::vector<float> even = test::shape_positions(Shape::sphere, 4000);
    const std::vector<float> random = test::picked(test::shape_positions(Shape::sphere, 80'000), 20);
    for (const auto& positions : {even, moved(even, 0.5 * spacing), moved(even, spacing), random,
                                  test::shape_positions(Shape::sphere, 4000, 20)}) {
        const Cloud cloud = test::cloud_of(positions);
        const AskedVertices asked = ask(cloud, cloud.size());
        EXPECT_FALSE(asked.fill_solid);
        EXPECT_NEAR(sum_of(asked.area) / 6, sphere, 0.05 * sphere);
    }
    const AskedVertices asked = ask(test::cloud_of(random), 80'000);
    EXPECT_LT(sum_of(asked.star) / 6, 0.8 * sphere);
}

// Twenty times as densely filled at one end: by spacings cubed, what halves hold comes out alike.
TEST(VertexAreas, AreVolumesInASolid) {
    for (const double gradient : {1, 20}) {
        const Cloud bar = test::cloud_of(test::shape_positions(Shape::solid_bar, 8000, gradient));
        const AskedVertices solid = ask(bar, bar.size());
        EXPECT_TRUE(solid.fill_solid);
        double upper = 0, lower = 0, upper_stars = 0, lower_stars = 0;
        for (std::size_t v = 0; v < bar.size(); ++v) {
            (bar.at(v).z() > 0 ? upper : lower) += solid.area[v];
            (bar.at(v).z() > 0 ? upper_stars : lower_stars) += solid.star[v];
        }
        EXPECT_NEAR(upper / lower, 1, 0.12);
        if (gradient > 1) {
            EXPECT_GT(std::abs(std::log(upper_stars / lower_stars)), 0.3);
        }
    }
}

TEST(VertexAreas, AreWhatStarsSayOnALine) {
    std::vector<float> row;
    for (int i = 0; i < 60; ++i) test::append(row, Vec3d(i, 0, 0));
    const AskedVertices line = ask(test::cloud_of(row, 2), 60);
    EXPECT_FALSE(line.fill_solid);
    EXPECT_EQ(line.area, line.star);
}

// Rows end at the rim: the points there stand for half as much.
TEST(VertexAreas, OfARimAreHalf) {
    const Cloud grid = test::cloud_of(test::grid_positions(20, 20), 8);
    const AskedVertices asked = ask(grid, grid.size());
    for (std::size_t v = 0; v < grid.size(); ++v) {
        const Vec3d p = grid.at(v);
        if (p.head<2>().minCoeff() >= 3 && p.head<2>().maxCoeff() <= 16) {
            EXPECT_NEAR(asked.area[v], 6, 1e-4);
        } else if (p.x() == 0 && p.y() >= 3 && p.y() <= 16) {
            EXPECT_NEAR(asked.area[v], 3, 1.5);
        }
    }
}

TEST(VertexAreas, OfSomeVerticesAreTheirShareOfAll) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::torus, 8000, 20));
    const AskedVertices all = ask(cloud, cloud.size()), some = ask(cloud, 1000);
    EXPECT_TRUE(all.all);
    EXPECT_EQ(all.each, std::vector<double>(cloud.size(), 1.0));
    ASSERT_EQ(some.vertex.size(), 1000U);
    EXPECT_FALSE(some.all);
    EXPECT_EQ(some.each, std::vector<double>(1000, 8.0));
    EXPECT_TRUE(std::ranges::is_sorted(some.vertex));
    EXPECT_NEAR(8 * sum_of(some.area), sum_of(all.area), 0.05 * sum_of(all.area));
    for (std::size_t k = 0; k < some.vertex.size(); ++k) EXPECT_EQ(some.area[k], all.area[some.vertex[k]]);
}

TEST(VertexAreas, OfOutliersThatHangAreNothing) {
    std::vector<float> positions = test::grid_positions(20, 20);
    const Cloud plain = test::cloud_of(positions, 8);
    test::append(positions, Vec3d(10, 10, 7)); // is linked to some of the grid
    const Cloud cloud = test::cloud_of(positions, 8);
    std::vector<std::uint8_t> hanging(cloud.size(), 0);
    for (std::size_t v = 0; v < cloud.size(); ++v) hanging[v] = cloud.at(v).z() > 1;
    const AskedVertices asked = ask(cloud, cloud.size(), 2, hanging);
    for (std::size_t v = 0; v < cloud.size(); ++v)
        if (hanging[v]) {
            EXPECT_EQ(asked.area[v] + asked.star[v] + asked.links[v], 0);
        }
    const double all = sum_of(ask(plain, plain.size()).area);
    EXPECT_NEAR(sum_of(asked.area), all, 1e-3 * all);
}

TEST(VertexAreas, AreTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 5000));
    const AskedVertices asked = ask(cloud, 2000);
    for (const unsigned threads : {1U, 5U}) {
        const AskedVertices again = ask(cloud, 2000, threads);
        EXPECT_EQ(again.vertex, asked.vertex);
        EXPECT_EQ(again.area, asked.area);
    }
}

// Squares of such lengths leave the range of floats.
TEST(VertexAreas, AreThoseOfAnySize) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 2000));
    const AskedVertices asked = ask(cloud, cloud.size());
    for (const int exponent : {-90, 90}) {
        Cloud scaled = cloud;
        for (float& each : scaled.positions) each = std::ldexp(each, exponent);
        const AskedVertices of_scaled = ask(scaled, cloud.size());
        for (std::size_t k = 0; k < asked.vertex.size(); ++k) {
            EXPECT_NEAR(std::ldexp(of_scaled.area[k], -2 * exponent), asked.area[k], 1e-9 * asked.area[k]);
            EXPECT_NEAR(std::ldexp(of_scaled.star[k], -2 * exponent), asked.star[k], 1e-9 * asked.star[k]);
        }
    }
}

// As a commit may leave it.
TEST(VertexAreas, OfWhatLiesInOnePlaceAreNothing) {
    Cloud cloud = test::cloud_of(test::grid_positions(8, 8));
    std::ranges::fill(cloud.positions, 1.0F);
    for (const double area : ask(cloud, cloud.size()).area) EXPECT_EQ(area, 0);
}

// With very many neighbours what is one link away is enough.
TEST(VertexAreas, HardlyDependOnTheNumberOfNeighbors) {
    const std::vector<float> positions = test::shape_positions(Shape::sphere, 3000);
    const double few = sum_of(ask(test::cloud_of(positions, 6), 3000).area);
    for (const std::size_t k : {4U, 10U, 30U})
        EXPECT_NEAR(sum_of(ask(test::cloud_of(positions, k), 3000).area), few, 0.03 * few) << k;
}

TEST(VertexAreas, OfNoneAreNone) {
    EXPECT_TRUE(ask(test::cloud_of(test::grid_positions(4, 4), 4), 0).vertex.empty());
}

} // namespace
} // namespace knead

#include "graph/cell_area.h"

#include "graph/clouds.h"

namespace knead {
namespace {

using test::Cloud;

std::vector<Cell> cells_of(const Cloud& cloud, const std::vector<std::uint8_t>& hanging = {}) {
    const Numbering point = Numbering::as_they_stand(cloud.size());
    CellFinder finder(cloud.graph, cloud.positions, point, hanging);
    std::vector<Cell> cells;
    for (Index v = 0; v < cloud.size(); ++v)
        cells.push_back(hanging.empty() || hanging[v] == 0 ? finder.find(v) : Cell{});
    return cells;
}

bool is_inside(const Vec3d& p, double edge) {
    return p.head<2>().minCoeff() > 3 && p.head<2>().maxCoeff() < edge - 3;
}

TEST(CellArea, OfAGridIsThatOfItsSquares) {
    const Cloud grid = test::cloud_of(test::grid_positions(20, 20), 8);
    const std::vector<Cell> cells = cells_of(grid);
    std::size_t inside = 0;
    for (std::size_t v = 0; v < grid.size(); ++v) {
        if (!is_inside(grid.at(v), 19)) continue;
        ++inside;
        EXPECT_NEAR(cells[v].area, 1, 1e-6);
        EXPECT_NEAR(cells[v].reach, std::sqrt(0.5), 1e-6);
        EXPECT_NEAR(cells[v].thickness, 0, 1e-9);
        EXPECT_NEAR(cells[v].width, 1, 0.1);
    }
    EXPECT_GT(inside, 100U);
}

// Without gaps or overlaps, though the points lie unevenly.
TEST(CellArea, OfAllPointsAddUpToTheSurface) {
    std::mt19937 random(7);
    std::vector<float> positions;
    for (int i = 0; i < 3600; ++i) {
        Vec3d p = Vec3d(i % 60, i / 60, 0) + 0.45 * test::random_vector(random);
        p.z() = 0;
        test::append(positions, p);
    }
    const Cloud cloud = test::cloud_of(positions, 8);
    const std::vector<Cell> cells = cells_of(cloud);
    double area = 0, squares = 0;
    std::size_t count = 0;
    for (std::size_t v = 0; v < cloud.size(); ++v) {
        if (!is_inside(cloud.at(v), 59)) continue;
        area += cells[v].area;
        squares += cells[v].area * cells[v].area;
        ++count;
    }
    const auto n = static_cast<double>(count);
    EXPECT_NEAR(area / n, 1, 0.01);
    EXPECT_GT(squares / n, 1.02); // none is like the other
}

TEST(CellArea, TellsRowsSheetsAndSolidsApart) {
    std::vector<float> row, solid;
    for (int i = 0; i < 60; ++i) test::append(row, Vec3d(i, 0, 0));
    for (int i = 0; i < 1000; ++i) test::append(solid, Vec3d(i % 10, i / 10 % 10, i / 100));
    for (const Cell& cell : cells_of(test::cloud_of(row, 2))) {
        EXPECT_NEAR(cell.thickness, 0, 1e-9);
        EXPECT_NEAR(cell.width, 0, 1e-6);
    }
    const Cloud block = test::cloud_of(solid);
    double thickness = 0;
    for (const Cell& cell : cells_of(block)) thickness += cell.thickness / static_cast<double>(block.size());
    EXPECT_GT(thickness, 0.3); // on the mean
}

TEST(CellArea, ReachesFarAtARim) {
    const Cloud grid = test::cloud_of(test::grid_positions(12, 12), 8);
    const std::vector<Cell> cells = cells_of(grid);
    for (std::size_t v = 0; v < grid.size(); ++v)
        if (grid.at(v).head<2>().minCoeff() == 0) {
            EXPECT_GT(cells[v].reach, 2);
        }
}

TEST(CellArea, KnowsNothingOfOutliersThatHang) {
    std::vector<float> positions = test::grid_positions(20, 20);
    const std::size_t surface = positions.size() / 3;
    for (int i = 0; i < 10; ++i) test::append(positions, Vec3d(5.4 + i, 9.6, 0.1));
    const Cloud cloud = test::cloud_of(positions, 8);
    std::vector<std::uint8_t> hanging(cloud.size(), 0);
    for (std::size_t v = 0; v < cloud.size(); ++v) hanging[v] = cloud.at(v).z() > 0.05;
    ASSERT_EQ(std::accumulate(hanging.begin(), hanging.end(), std::size_t{0}), cloud.size() - surface);
    const std::vector<Cell> cells = cells_of(cloud, hanging);
    for (std::size_t v = 0; v < cloud.size(); ++v)
        if (hanging[v] == 0 && is_inside(cloud.at(v), 19)) {
            EXPECT_NEAR(cells[v].area, 1, 1e-6);
        }
}

TEST(CellArea, IsNothingOfTooFewPointsOrOfOnePlace) {
    const Cloud pair = test::cloud_of({0, 0, 0, 1, 0, 0});
    for (const Cell& cell : cells_of(pair)) EXPECT_EQ(cell.area, 0);
    Cloud place = test::cloud_of(test::grid_positions(4, 4));
    std::ranges::fill(place.positions, 1.0F);
    for (const Cell& cell : cells_of(place)) EXPECT_EQ(cell.area, 0);
}

} // namespace
} // namespace knead

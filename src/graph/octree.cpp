#include "graph/octree.h"

#include <algorithm>
#include <bit>
#include <limits>
#include <queue>

namespace knead {

namespace {

// A range of `among`.
struct Cell {
    std::size_t begin, end;

    // What is halved first: the fullest, and of equals the first on the curve.
    bool operator<(const Cell& other) const {
        const std::size_t size = end - begin;
        const std::size_t other_size = other.end - other.begin;
        return size != other_size ? size < other_size : begin > other.begin;
    }
};

// Where a cell of at least two vertices is halved: at the first bit in which the Morton codes of its vertices
// differ. Vertices of one code cannot be told apart on the curve, and are halved by number.
std::size_t middle_of(const Cell& cell, const MortonCube& cube, std::span<const float> positions,
                      std::span<const Index> among) {
    const auto code = [&](Index v) { return morton_code(point_at(positions, v), cube); };
    const std::uint64_t differing = code(among[cell.begin]) ^ code(among[cell.end - 1]);
    if (differing == 0) return (cell.begin + cell.end) / 2;
    const std::uint64_t bit = std::bit_floor(differing);
    const auto lower = among.begin() + static_cast<std::ptrdiff_t>(cell.begin);
    const auto upper = among.begin() + static_cast<std::ptrdiff_t>(cell.end);
    return static_cast<std::size_t>(
        std::partition_point(lower, upper, [&](Index v) { return !(code(v) & bit); }) - among.begin());
}

Index nearest_to_mean(const Cell& cell, std::span<const float> positions, std::span<const Index> among) {
    Vec3d sum = Vec3d::Zero();
    for (std::size_t i = cell.begin; i < cell.end; ++i) sum += point_at(positions, among[i]);
    const Vec3d mean = sum / static_cast<double>(cell.end - cell.begin);
    Index nearest = among[cell.begin];
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t i = cell.begin; i < cell.end; ++i) {
        const double squared = (point_at(positions, among[i]) - mean).squaredNorm();
        if (squared < smallest) {
            smallest = squared;
            nearest = among[i];
        }
    }
    return nearest;
}

} // namespace

std::vector<Index> octree_samples(const MortonCube& cube, std::span<const float> positions,
                                  std::span<const Index> among, std::size_t count) {
    if (among.size() <= count) return {among.begin(), among.end()};
    if (count == 0) return {};
    std::priority_queue<Cell> cells;
    cells.push({0, among.size()});
    while (cells.size() < count) {
        const Cell cell = cells.top();
        cells.pop();
        const std::size_t middle = middle_of(cell, cube, positions, among);
        cells.push({cell.begin, middle});
        cells.push({middle, cell.end});
    }
    std::vector<Index> samples;
    samples.reserve(count);
    for (; !cells.empty(); cells.pop()) samples.push_back(nearest_to_mean(cells.top(), positions, among));
    std::ranges::sort(samples);
    return samples;
}

} // namespace knead

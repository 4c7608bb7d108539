#include "graph/octree.h"

#include "graph/scrambled.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <queue>

namespace knead {

namespace {

constexpr double way_aside = 0.5; // of that to any one vertex

// A range of `among`.
struct Cell {
    std::size_t begin, end;
    double weight;

    // What is halved first: the heaviest, and of equals the first on the curve.
    bool operator<(const Cell& other) const {
        return weight != other.weight ? weight < other.weight : begin > other.begin;
    }
};

// Its vertices times the edge of the octree's cell that just holds them, in edges of the smallest cell there
// is: 1 for a lone vertex, more for any others.
Cell weighed(std::size_t begin, std::size_t end, const MortonCube& cube, std::span<const float> positions,
             std::span<const Index> among) {
    constexpr double halved[] = {1, 1.2599210498948732, 1.5874010519681994}; // 2^0, 2^⅓, 2^⅔
    const auto code = [&](std::size_t at) { return morton_code(point_at(positions, among[at]), cube); };
    const auto bits = std::bit_width(code(begin) ^ code(end - 1));
    const double edge = std::ldexp(halved[bits % 3], static_cast<int>(bits / 3));
    return {begin, end, static_cast<double>(end - begin) * edge};
}

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

Index sample_of(const Cell& cell, OfCell which, std::span<const float> positions,
                std::span<const Index> among) {
    const auto own = among.subspan(cell.begin, cell.end - cell.begin);
    Vec3d sum = Vec3d::Zero();
    for (const Index v : own) sum += point_at(positions, v);
    Vec3d target = sum / static_cast<double>(own.size());
    if (which == OfCell::aside)
        target += way_aside * (point_at(positions, own[scrambled(own.front()) % own.size()]) - target);
    return *std::ranges::min_element(
        own, {}, [&](Index v) { return (point_at(positions, v) - target).squaredNorm(); });
}

} // namespace

std::vector<Index> octree_samples(const MortonCube& cube, std::span<const float> positions,
                                  std::span<const Index> among, std::size_t count, OfCell which) {
    if (among.size() <= count) return {among.begin(), among.end()};
    if (count == 0) return {};
    std::priority_queue<Cell> cells;
    cells.push(weighed(0, among.size(), cube, positions, among));
    while (cells.size() < count) {
        const Cell cell = cells.top();
        cells.pop();
        const std::size_t middle = middle_of(cell, cube, positions, among);
        cells.push(weighed(cell.begin, middle, cube, positions, among));
        cells.push(weighed(middle, cell.end, cube, positions, among));
    }
    std::vector<Index> samples;
    samples.reserve(count);
    for (; !cells.empty(); cells.pop()) samples.push_back(sample_of(cells.top(), which, positions, among));
    std::ranges::sort(samples);
    return samples;
}

} // namespace knead

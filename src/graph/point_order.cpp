#include "graph/point_order.h"

#include "base/large_pages.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t grain = 1 << 14;
constexpr int bits_an_axis = 21;

struct Keyed {
    std::uint64_t code;
    Index point;
};

// Puts two zero bits between any two bits of the lowest 21.
std::uint64_t spread(std::uint64_t bits) {
    bits &= 0x1fffff;
    bits = (bits | bits << 32) & 0x001f00000000ffff;
    bits = (bits | bits << 16) & 0x001f0000ff0000ff;
    bits = (bits | bits << 8) & 0x100f00f00f00f00f;
    bits = (bits | bits << 4) & 0x10c30c30c30c30c3;
    bits = (bits | bits << 2) & 0x1249249249249249;
    return bits;
}

bool finite_at(std::span<const float> positions, std::size_t i) {
    return std::isfinite(positions[3 * i]) && std::isfinite(positions[3 * i + 1]) &&
           std::isfinite(positions[3 * i + 2]);
}

// One stable pass of a radix sort, by the digit at `shift`, across the workers: a histogram a chunk, then
// each chunk knows where its items of every digit go.
void radix_pass(std::span<const Keyed> from, std::span<Keyed> to, int shift, Workers& workers) {
    constexpr std::size_t digits = 1 << 11;
    const std::size_t chunk = std::max<std::size_t>(grain, from.size() / 16 + 1);
    const std::size_t chunks = (from.size() + chunk - 1) / chunk;
    std::vector<std::array<Index, digits>> begins(chunks);
    const auto digit = [shift](const Keyed& item) { return (item.code >> shift) & (digits - 1); };

    workers.for_chunks(from.size(), chunk, [&](std::size_t begin, std::size_t end) {
        auto& counts = begins[begin / chunk];
        counts.fill(0);
        for (std::size_t i = begin; i < end; ++i) ++counts[digit(from[i])];
    });
    Index total = 0;
    for (std::size_t d = 0; d < digits; ++d)
        for (auto& counts : begins) total += std::exchange(counts[d], total);
    workers.for_chunks(from.size(), chunk, [&](std::size_t begin, std::size_t end) {
        auto& next = begins[begin / chunk];
        for (std::size_t i = begin; i < end; ++i) to[next[digit(from[i])]++] = from[i];
    });
}

void sort_by_code(std::vector<Keyed>& items, Workers& workers) {
    auto other = zeros_in_large_pages<Keyed>(items.size(), workers);
    for (int shift = 0; shift < 3 * bits_an_axis; shift += 11) {
        radix_pass(items, other, shift, workers);
        items.swap(other);
    }
}

// Points in one cell of the curve go by their coordinates, and equal ones stay in the order of the file.
void sort_within_cells(std::vector<Keyed>& items, std::span<const float> positions) {
    const auto key = [&](const Keyed& item) {
        const float* p = positions.data() + 3 * std::size_t{item.point};
        return std::tuple(p[0], p[1], p[2], item.point);
    };
    for (std::size_t begin = 0; begin < items.size();) {
        std::size_t end = begin + 1;
        while (end < items.size() && items[end].code == items[begin].code) ++end;
        if (end - begin > 1)
            std::sort(items.begin() + static_cast<std::ptrdiff_t>(begin),
                      items.begin() + static_cast<std::ptrdiff_t>(end),
                      [&](const Keyed& a, const Keyed& b) { return key(a) < key(b); });
        begin = end;
    }
}

bool same_position(std::span<const float> positions, Index a, Index b) {
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (positions[3 * std::size_t{a} + axis] != positions[3 * std::size_t{b} + axis]) return false;
    return true;
}

// The order of points that are sorted already.
PointOrder numbered(std::span<const Keyed> items, std::span<const float> positions) {
    const auto begins_vertex = [&](std::size_t i) {
        return i == 0 || !same_position(positions, items[i].point, items[i - 1].point);
    };
    std::size_t vertices = 0;
    for (std::size_t i = 0; i < items.size(); ++i) vertices += begins_vertex(i) ? 1 : 0;

    PointOrder order;
    order.file_index.resize(items.size());
    std::ranges::transform(items, order.file_index.begin(), &Keyed::point);
    if (vertices == items.size()) {
        order.vertex = Numbering::as_they_stand(vertices);
        order.first_point = Numbering::as_they_stand(vertices + 1);
        return order;
    }
    std::vector<Index> vertex(items.size()), first_point;
    first_point.reserve(vertices + 1);
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (begins_vertex(i)) first_point.push_back(static_cast<Index>(i));
        vertex[i] = static_cast<Index>(first_point.size() - 1);
    }
    first_point.push_back(static_cast<Index>(items.size()));
    order.vertex = Numbering(std::move(vertex));
    order.first_point = Numbering(std::move(first_point));
    return order;
}

} // namespace

MortonCube morton_cube(std::span<const float> positions) {
    Vec3d lowest = Vec3d::Constant(std::numeric_limits<double>::infinity());
    Vec3d highest = -lowest;
    for (std::size_t i = 0; i < positions.size() / 3; ++i) {
        if (!finite_at(positions, i)) continue;
        lowest = lowest.cwiseMin(point_at(positions, i));
        highest = highest.cwiseMax(point_at(positions, i));
    }
    const double edge = (highest - lowest).maxCoeff();
    if (edge < 0) return {}; // there is no finite point
    return {lowest, edge > 0 ? edge : 1};
}

std::uint64_t morton_code(const Vec3d& position, const MortonCube& cube) {
    constexpr double cells = 1 << bits_an_axis;
    std::uint64_t code = 0;
    for (int axis = 0; axis < 3; ++axis) {
        const double cell =
            std::clamp((position[axis] - cube.lowest[axis]) / cube.edge * cells, 0.0, cells - 1);
        code |= spread(static_cast<std::uint64_t>(cell)) << (2 - axis);
    }
    return code;
}

PointOrder order_points(std::span<const float> positions, Workers& workers, Progress& progress) {
    const std::size_t points = positions.size() / 3;
    require(points < no_index, "a cloud has at most 2^32 - 2 points");
    progress.step("ordering the points", 0);
    std::vector<Keyed> items;
    items.reserve(points);
    take_large_pages(items.data(), points * sizeof(Keyed), workers);
    for (std::size_t i = 0; i < points; ++i)
        if (finite_at(positions, i)) items.push_back({0, static_cast<Index>(i)});

    const MortonCube cube = morton_cube(positions);
    workers.for_each(items.size(), grain, [&](std::size_t i) {
        items[i].code = morton_code(point_at(positions, items[i].point), cube);
    });
    sort_by_code(items, workers);
    progress.step("ordering the points", 0.6);
    sort_within_cells(items, positions);

    PointOrder order = numbered(items, positions);
    order.cube = cube;
    progress.report("ordering the points", 1);
    return order;
}

void gather(const PointOrder& order, std::span<const float> file_values, std::size_t width,
            std::span<float> ordered, Workers& workers) {
    workers.for_each(order.points(), grain, [&](std::size_t i) {
        std::copy_n(file_values.data() + order.file_index[i] * width, width, ordered.data() + i * width);
    });
}

void scatter(const PointOrder& order, std::span<const float> ordered, std::size_t width,
             std::span<float> file_values, Workers& workers) {
    workers.for_each(order.points(), grain, [&](std::size_t i) {
        std::copy_n(ordered.data() + i * width, width, file_values.data() + order.file_index[i] * width);
    });
}

std::vector<float> vertex_positions(const PointOrder& order, std::span<const float> ordered_positions,
                                    Workers& workers) {
    std::vector<float> positions(3 * order.vertices());
    workers.for_each(order.vertices(), grain, [&](std::size_t v) {
        std::copy_n(ordered_positions.data() + 3 * std::size_t{order.first_point[v]}, 3,
                    positions.data() + 3 * v);
    });
    return positions;
}

} // namespace knead

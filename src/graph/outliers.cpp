#include "graph/outliers.h"

#include "base/large_pages.h"
#include "graph/bridges.h"
#include "graph/group_tree.h"
#include "graph/neighbors.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t grain = 2048;

constexpr double mist_reach = 10;          // of its own spacings
constexpr std::size_t smallest_share = 10; // mist is less than a tenth

// A vertex is in a plane where so much of its links' squares, or less, lies across it. Among points that fill
// a space it is 5 to 30 % for most.
constexpr double flat = 0.02;
constexpr std::size_t fewest_links = 4;

float squared_distance(std::span<const float> positions, std::size_t v, std::size_t u) {
    const float x = positions[3 * v] - positions[3 * u];
    const float y = positions[3 * v + 1] - positions[3 * u + 1];
    const float z = positions[3 * v + 2] - positions[3 * u + 2];
    return x * x + y * y + z * z;
}

// The third lowest of a row's values, or the highest of fewer; 0 of none. Without a branch: there is nothing
// for a processor to guess.
template<typename ValueOf>
float third_of(std::span<const Index> row, ValueOf&& value_of) {
    if (row.empty()) return 0;
    constexpr float none = std::numeric_limits<float>::infinity();
    std::array<float, 3> lowest{none, none, none};
    for (const Index u : row) {
        float next = value_of(u);
        for (float& held : lowest) {
            const float higher = std::max(held, next);
            held = std::min(held, next);
            next = higher;
        }
    }
    return lowest[std::min(row.size(), lowest.size()) - 1];
}

// The pieces that are left when long links are cut.
Components cut_long_links(const Graph& graph, std::span<const float> positions,
                          std::span<const float> spacing, Workers& workers) {
    auto is_short = zeros_in_large_pages<std::uint8_t>(graph.neighbor.size(), workers);
    constexpr auto limit = static_cast<float>(short_way * short_way);
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
            const Index u = graph.neighbor[link];
            const float lower = std::min(spacing[v], spacing[u]);
            is_short[link] = squared_distance(positions, v, u) <= limit * lower * lower ? 1 : 0;
        }
    });
    return find_components(graph, is_short, workers);
}

// Of each vertex, whether it sticks out from the pieces that are larger than crumbs.
std::vector<std::uint8_t> find_sticking_out(std::span<const float> positions, const Spacings& spacings,
                                            const Components& pieces, Workers& workers) {
    const auto is_crumb = [&](std::size_t v) { return pieces.size[pieces.component[v]] < crumb; };
    std::vector<Index> group = pieces.component.of_all();
    for (std::size_t v = 0; v < group.size(); ++v)
        if (is_crumb(v)) group[v] = no_index;
    const GroupTree tree = group_tree(positions, group, workers);
    std::vector<std::uint8_t> result(group.size(), 0);
    workers.for_each(group.size(), 256, [&](std::size_t v) {
        if (smallest_share * pieces.size[pieces.component[v]] >= group.size()) return;
        const auto own = static_cast<double>(spacings.own[v]);
        const double reach = is_crumb(v) ? std::numeric_limits<double>::infinity() : mist_reach * own;
        const Neighbor other = nearest_of_others(tree, v, reach);
        if (other.vertex == no_index) return;
        // Of the two spacings the larger: among points in clumps nothing sticks out from a clump.
        const float there = std::max(spacings.own[other.vertex], spacings.around[other.vertex]);
        const double limit = short_way * static_cast<double>(there);
        result[v] = other.distance > limit && (is_crumb(v) || own > limit) ? 1 : 0;
    });
    return result;
}

// Whether a vertex lies in one plane with the neighbours that it has in its piece, or on one line.
bool lies_flat(const Graph& graph, std::span<const float> positions, const Components& pieces,
               std::size_t v) {
    Mat3d spread = Mat3d::Zero();
    std::size_t links = 0;
    for (const Index u : graph.row(v)) {
        if (pieces.component[u] != pieces.component[v]) continue;
        const Vec3d edge = point_at(positions, u) - point_at(positions, v);
        spread += edge * edge.transpose();
        ++links;
    }
    if (links < fewest_links) return false;
    Eigen::SelfAdjointEigenSolver<Mat3d> squares;
    squares.computeDirect(spread, Eigen::EigenvaluesOnly);
    return squares.eigenvalues()[0] < flat * spread.trace();
}

// Of each piece that most vertices of stick out, whether it is a surface all the same: a sparse part of a
// scan where a denser one ends, and not mist above it.
std::vector<bool> find_surfaces(const Graph& graph, std::span<const float> positions,
                                const Components& pieces, const std::vector<std::uint8_t>& is_out) {
    std::vector<std::size_t> count(pieces.size.size(), 0);
    for (std::size_t v = 0; v < is_out.size(); ++v) {
        const Index piece = pieces.component[v];
        if (is_out[v] && pieces.size[piece] >= crumb) count[piece] += lies_flat(graph, positions, pieces, v);
    }
    std::vector<bool> surfaces(count.size());
    for (std::size_t piece = 0; piece < count.size(); ++piece)
        surfaces[piece] = 2 * count[piece] > pieces.size[piece];
    return surfaces;
}

} // namespace

Spacings find_spacings(const Graph& graph, std::span<const float> positions, Workers& workers) {
    Spacings spacings;
    resize_in_large_pages(spacings.own, graph.size(), workers);
    resize_in_large_pages(spacings.around, graph.size(), workers);
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        spacings.own[v] =
            std::sqrt(third_of(graph.row(v), [&](Index u) { return squared_distance(positions, v, u); }));
    });
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        spacings.around[v] = third_of(graph.row(v), [&](Index u) { return spacings.own[u]; });
    });
    return spacings;
}

std::vector<std::uint8_t> find_outliers(const Graph& graph, std::span<const float> positions,
                                        const Spacings& spacings, Workers& workers) {
    const Components pieces = cut_long_links(graph, positions, spacings.around, workers);
    const auto may_be_outliers = [&](std::size_t size) { return smallest_share * size < graph.size(); };
    if (std::ranges::none_of(pieces.size, may_be_outliers)) return std::vector<std::uint8_t>(graph.size(), 0);
    const std::vector<std::uint8_t> sticks_out = find_sticking_out(positions, spacings, pieces, workers);
    std::vector<std::size_t> count(pieces.size.size(), 0);
    for (std::size_t v = 0; v < sticks_out.size(); ++v) count[pieces.component[v]] += sticks_out[v];
    std::vector<std::uint8_t> hanging(graph.size());
    for (std::size_t v = 0; v < hanging.size(); ++v) {
        const Index piece = pieces.component[v];
        hanging[v] = 2 * count[piece] > pieces.size[piece] ? 1 : 0;
    }
    const std::vector<bool> surfaces = find_surfaces(graph, positions, pieces, hanging);
    for (std::size_t v = 0; v < hanging.size(); ++v)
        if (surfaces[pieces.component[v]]) hanging[v] = 0;
    return hanging;
}

} // namespace knead

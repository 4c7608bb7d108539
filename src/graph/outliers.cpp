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

namespace knead {

namespace {

constexpr std::size_t grain = 2048;

constexpr double mist_reach = 10;          // of its own spacings
constexpr std::size_t smallest_share = 10; // mist is less than a tenth

// A vertex is in a plane where so much of its links' squares, or less, lies across it. Among points that fill
// a space it is 5 to 30 % for most.
constexpr double flat = 0.02;
constexpr std::size_t fewest_links = 4;

// Squares are those of floats, of which a processor has many at once, where floats can hold them: from 1e-19
// units to 1e19. Doubles hold those of every distance between floats.
template<typename Number>
Number squared_distance(std::span<const float> positions, std::size_t v, std::size_t u) {
    const Number x = Number{positions[3 * v]} - Number{positions[3 * u]};
    const Number y = Number{positions[3 * v + 1]} - Number{positions[3 * u + 1]};
    const Number z = Number{positions[3 * v + 2]} - Number{positions[3 * u + 2]};
    return x * x + y * y + z * z;
}

// The third lowest of a row's values, or the highest of fewer; 0 of none. Without a branch: there is nothing
// for a processor to guess.
template<typename Number, typename ValueOf>
Number third_of(std::span<const Index> row, ValueOf&& value_of) {
    if (row.empty()) return 0;
    constexpr Number none = std::numeric_limits<Number>::infinity();
    std::array<Number, 3> lowest{none, none, none};
    for (const Index u : row) {
        Number next = value_of(u);
        for (Number& held : lowest) {
            const Number higher = std::max(held, next);
            held = std::min(held, next);
            next = higher;
        }
    }
    return lowest[std::min(row.size(), lowest.size()) - 1];
}

// How far away the third nearest neighbour of a vertex is.
float third_distance(const Graph& graph, std::span<const float> positions, std::size_t v) {
    const auto third_square = [&]<typename Number>(Number /*of them*/) {
        return third_of<Number>(graph.row(v),
                                [&](Index u) { return squared_distance<Number>(positions, v, u); });
    };
    const float square = third_square(0.0F);
    return std::isnormal(square) ? std::sqrt(square) : static_cast<float>(std::sqrt(third_square(0.0)));
}

// Whether a link is no longer than short_way of the lower spacing of its ends.
bool is_short_link(std::span<const float> positions, std::size_t v, std::size_t u, float spacing) {
    constexpr auto limit = static_cast<float>(short_way * short_way);
    const auto square = squared_distance<float>(positions, v, u);
    const float longest = limit * spacing * spacing;
    if (std::isnormal(square) && std::isnormal(longest)) return square <= longest;
    return squared_distance<double>(positions, v, u) <= double{limit} * double{spacing} * double{spacing};
}

// The pieces that are left when long links are cut.
Components cut_long_links(const Graph& graph, std::span<const float> positions,
                          std::span<const float> spacing, Workers& workers) {
    auto is_short = zeros_in_large_pages<std::uint8_t>(graph.neighbor.size(), workers);
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
            const Index u = graph.neighbor[link];
            const float lower = std::min(spacing[v], spacing[u]);
            is_short[link] = is_short_link(positions, v, u, lower) ? 1 : 0;
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
    workers.for_each(graph.size(), grain,
                     [&](std::size_t v) { spacings.own[v] = third_distance(graph, positions, v); });
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        spacings.around[v] = third_of<float>(graph.row(v), [&](Index u) { return spacings.own[u]; });
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

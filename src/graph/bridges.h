#pragma once
// What a scan holds beside its surface: outliers, and the parts that it falls into. Outliers hang on the
// surface whatever the setting `strays` says; parts become one body where it says "bridge".
//
// Everything is judged from the spacing of the points round about, never from the size of the cloud. A
// vertex's *own* spacing is the distance to its third nearest neighbour, on an even surface about the
// distance of rows: nearer ones may be nearly the same point, seen twice. The spacing *around* it is the
// third lowest of its neighbours' own, so that a few that are out of the ordinary do not count.
//
//   - **Bridges.** Wherever a vertex of any component but the largest has vertices of others within
//     `widest_gap` of the spacings around both ends, the nearest of them is linked to it. Of both: points
//     that are rare reach nowhere, and sparse parts not into dense ones. Two sheets that run along each other
//     are so sewn together all along, and not hinged at one place. The bodies that components have become
//     then look for others in the same way, until none finds any. What is too far stays apart. Nothing is
//     ever linked within a component: limbs that nearly touch stay as separate as they were.
//   - **Outliers** keep no links but one, to the nearest vertex that is none, of whatever component. There
//     they hang like dust, go where it goes, and neither pull at the surface nor tie surfaces together that
//     they lie between. With bridges what only outliers tied together comes apart, and may be bridged.
//     Without, it stays together by as few links as that takes (graph/dust.h), and a part of nothing but
//     outliers is a part like others.
//     Cut all links that are longer than `short_way` of the spacings around both ends: the pieces that are
//     then left are outliers if they are less than a tenth of all vertices, most of theirs stick out, farther
//     than `short_way` of the spacing there from the nearest vertex of another piece, and
//         - they are crumbs, of fewer than `crumb` vertices, or
//         - they are mist: that vertex lies within ten of a vertex's own spacings, and the spacing there is
//           less than that by a factor of `short_way`; but they are no surface: a sparse part of a scan that
//           goes on where a denser one ends, of whose vertices most lie in a plane, or on a line, with those
//           of their neighbours that are of the same piece.
//     Crumbs are never what others stick out from.

#include "graph/neighbors.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace knead {

inline constexpr double widest_gap = 8;
inline constexpr double short_way = 2.5;
inline constexpr std::size_t crumb = 7;

struct JoinedGraph {
    Graph graph;                       // of the same vertices
    std::vector<std::uint8_t> hanging; // of each vertex: 1 if it is an outlier, a leaf of the graph
    std::size_t joints = 0;            // links that join what would be components without them
    std::size_t outliers = 0;          // vertices that hang
};

// Whether a vertex does, by JoinedGraph::hanging; where that is empty none does.
inline bool hangs(std::span<const std::uint8_t> hanging, std::size_t vertex) {
    return !hanging.empty() && hanging[vertex] != 0;
}

// `graph`: of the nearest neighbours (neighbor_graph()); `positions`: 3 floats a vertex, in Morton order.
// The result is the same whatever the number of workers.
JoinedGraph bridged(const Graph& graph, std::span<const float> positions, Workers& workers,
                    Progress& progress);

// The same without bridges; nothing if no outlier is to hang.
std::optional<JoinedGraph> with_hanging_outliers(const Graph& graph, std::span<const float> positions,
                                                 Workers& workers, Progress& progress);

} // namespace knead

#pragma once
// The nearest samples of every vertex along the surface.
//
// The paper's Algorithm 1 searches the graph from every point until it has met K samples. Here all samples
// flood the graph together, and a vertex keeps the K nearest that reach it: the same sets at about O(n K k)
// instead of O(n r) for searches of r vertices (a little more, as what comes by a way round before it comes
// by the shortest is sent on twice). It is enough that a vertex passes on what it keeps: if s is among the K
// first at p, it is among the K first at the vertex before p on a shortest way from s, because whatever beats
// it there beats it at p too. Vertices should be numbered so that neighbours have near numbers (PointOrder):
// the flood goes through them in tiles that fit into a cache.
//
// A link is 1 to 255 levels long. With all of them 1, distance is the number of links, as in the paper. knead
// measures them by their length (link_lengths()): the number of links follows the lattice that a scanner left
// rather than the surface, and on the survey's cylinder it tore the tube apart between rings. Equal distances
// go by sample number, so samples should be numbered in no particular direction, and, as whatever is kept of
// them is looked up by number, those that are near each other by near numbers (shuffle_in_runs()).

#include "base/pile.h"
#include "base/progress.h"
#include "base/workers.h"
#include "graph/csr.h"
#include "graph/influences.h"

#include <cstdint>
#include <span>
#include <variant>
#include <vector>

namespace knead {

// Floods the graph from `samples`, which are different vertices; sample s is the one at samples[s].
// `lengths`: one entry for every entry of graph.neighbor, 1 … 255, the same in both directions. Returns one
// row a vertex: narrow ones for fewer than 65,535 samples, unless one of them is met so far away that a
// narrow row cannot tell its distance; then it starts over with wide ones.
InfluenceRows flood(const Graph& graph, std::span<const std::uint8_t> lengths, std::span<const Index> samples,
                    Workers& workers, Progress& progress);

// The same for K = 1: each vertex's nearest sample, no_index in a component without samples.
std::vector<Index> territories(const Graph& graph, std::span<const std::uint8_t> lengths,
                               std::span<const Index> samples, Workers& workers, Progress& progress);

// The first places of these rows.
TerritoryRows territory_rows(const InfluenceRows& nearest, Workers& workers);

// What add_starts() changed: whole rows as they were before, each vertex once, by block
// of rows.
template<typename Row>
struct OldRow {
    Index vertex;
    decltype(Row::sample) sample; // not a Row, which would be padded here
    decltype(Row::distance) distance;
};
template<typename Row>
using OldRows = std::vector<Pile<OldRow<Row>>>; // blocks_of_rows() of them

template<std::size_t places>
struct RowPatch {
    using Rows = NearestRows<places>;
    std::variant<OldRows<typename Rows::Narrow>, OldRows<typename Rows::Wide>> blocks;
};
using FloodPatch = RowPatch<influences_per_row>;
using TerritoryPatch = RowPatch<1>;

// Where a flood starts, and what: the number that rows will hold; and how far away it is there already, in
// levels.
struct FloodStart {
    Index vertex;
    Index number;
    Index distance = 0;
    bool operator==(const FloodStart&) const = default;
};

// A sample at each of these vertices, numbered first, first + 1, …
std::vector<FloodStart> starts_of(std::span<const Index> samples, Index first);

// Adds what starts there, as if it had been in the flood from the beginning; only what it reaches is flooded.
// One that starts from several vertices at once, or later from more of them, is as far from any other as the
// nearest of them is. The vertices may hold samples. Rows that have become too narrow are made wide. A flood
// that is cancelled leaves rows that are good for nothing. Of territories alone it is much less to flood.
template<std::size_t places> // influences_per_row, or 1
RowPatch<places> add_starts(NearestRows<places>& nearest, const Graph& graph,
                            std::span<const std::uint8_t> lengths, std::span<const FloodStart> starts,
                            Workers& workers, Progress& progress);

} // namespace knead

#pragma once
// From lists of directed links to a symmetric graph. All of these throw Error (input) where it would have
// more links than an Index can number, both directions counted.

#include "base/workers.h"
#include "graph/csr.h"

#include <cstdint>
#include <span>
#include <utility>

namespace knead {

// The graph that has every link i → j of the lists, and its back link j → i where the lists lack it. `lists`
// holds `width` places a vertex, tightly packed; no_index marks an empty place. No list names its own vertex,
// or another vertex twice. The result is the same whatever the number of workers.
Graph symmetric_graph(std::span<const Index> lists, std::size_t width, Workers& workers);

// `graph` with further undirected edges (pairs may repeat, and may be there already).
Graph with_edges(const Graph& graph, std::span<const std::pair<Index, Index>> edges, Workers& workers);

// The links of `graph` whose entry in `stays` is not 0 (one for every entry of graph.neighbor, the same for
// both directions of a link), and the undirected ones of `added`, which may repeat but not name a link that
// stays.
Graph rewired(const Graph& graph, std::span<const std::uint8_t> stays,
              std::span<const std::pair<Index, Index>> added, Workers& workers);

} // namespace knead

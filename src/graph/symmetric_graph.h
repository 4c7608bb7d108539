#pragma once
// From lists of directed links to a symmetric graph.

#include "base/workers.h"
#include "graph/csr.h"

#include <span>

namespace knead {

// The graph that has every link i → j of the lists, and its back link j → i where the lists lack it. `lists`
// holds `width` places a vertex, tightly packed; no_index marks an empty place. No list names its own vertex,
// or another vertex twice. The result is the same whatever the number of workers.
Graph symmetric_graph(std::span<const Index> lists, std::size_t width, Workers& workers);

// `graph` with further undirected edges (pairs may repeat, and may be there already).
Graph with_edges(const Graph& graph, std::span<const std::pair<Index, Index>> edges);

} // namespace knead

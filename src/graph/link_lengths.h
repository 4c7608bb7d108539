#pragma once
// How long the links of the graph are, in the whole levels by which a flood (graph/flood.h) measures ways.

#include "base/workers.h"
#include "graph/csr.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

inline constexpr std::uint32_t longest_link = 255; // levels

// How long each link is, in levels: its length over a sixteenth of the median, rounded, 1 … 255; one entry
// for every entry of graph.neighbor. `positions`: 3 floats a vertex.
std::vector<std::uint8_t> link_lengths(const Graph& graph, std::span<const float> positions,
                                       Workers& workers);

} // namespace knead

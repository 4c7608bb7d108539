#pragma once
// How much of the links between samples lies on what handles hold.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/influences.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// The samples, and the cloud that they are of.
struct SampledCloud {
    const Graph& between;                  // the samples
    std::span<const Index> samples;        // the vertex of each
    std::span<const Index> label;          // of each vertex: its handle, or no_index
    const Graph& graph;                    // of the vertices
    std::span<const std::uint8_t> lengths; // link_lengths() of that
    std::span<const float> positions;      // 3 floats a vertex
    const InfluenceRows& nearest;          // of each vertex; empty if every point is a sample
};

// Of each link from a free sample to a held one, 0 … 1: a handle ends halfway between the last vertex that it
// holds and the next one, and how far from its border both samples are is told by their rows, in which
// handles start from all along it. Where one does not tell, links are taken to go straight away from the
// border; and where every point is a sample, half of each lies on the handle. 0 for all other links.
std::vector<float> held_parts(const SampledCloud& cloud, Workers& workers);

} // namespace knead

#pragma once
// How finely the handles divide a cloud, and so how many samples they ask for (edit/sample_choice.h).

#include "edit/handle_labels.h"
#include "graph/csr.h"

#include <span>

namespace knead {

struct HandleSpread {
    std::size_t count = 0; // handles that hold something
    double smallest = 1;   // its part of the vertices, in (0, 1]; 1 without handles
    // How close handles come, along the surface: links between samples from one to the next, over √m for m
    // samples, which is much the same whatever m is. Handles that touch count for nothing: nothing between
    // them bends. 1 without two handles.
    double closest = 1;
};

// `labels`: who holds each vertex; what lies outside a region of interest is a neighbour like the handles,
// but none of them. `points`: the graph of the vertices. `samples`: their vertices, and `between` the graph
// between them.
HandleSpread spread_of(const HandleLabels& labels, const Graph& points, std::span<const Index> samples,
                       const Graph& between);

} // namespace knead

#pragma once
// How far apart the points of a cloud are, place by place, and which of them stick out. graph/bridges.h says
// what is meant by the words.

#include "base/workers.h"
#include "graph/csr.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// One entry a vertex; 0 for one without neighbours.
struct Spacings {
    std::vector<float> own;
    std::vector<float> around;
};

// `graph`: of the nearest neighbours; `positions`: 3 floats a vertex.
Spacings find_spacings(const Graph& graph, std::span<const float> positions, Workers& workers);

// Of each vertex, 1 if it is an outlier: never all of them. `positions`: in Morton order.
std::vector<std::uint8_t> find_outliers(const Graph& graph, std::span<const float> positions,
                                        const Spacings& spacings, Workers& workers);

} // namespace knead

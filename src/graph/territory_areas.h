#pragma once
// How much of the surface each sample stands for.

#include "base/workers.h"
#include "graph/changing_territories.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// Some vertices, evenly spread along their order, and what each stands for where every point is a sample:
// Σ_j w_ij |e_ij|² of its weights (edge_weights.h), as far as it knows them by itself.
struct AskedVertices {
    std::vector<Index> vertex; // ascending
    std::vector<float> area;   // of each; 0 for an outlier that hangs
    double each = 1;           // they stand for so many vertices each
};

// Asks so many vertices a sample that more change nothing, or all there are. `points`: the graph of the
// vertices; `positions`: 3 floats a point, of which `point` names one for each vertex; `hanging`: of each
// vertex 1 for an outlier, which counts neither itself nor as a neighbour; empty without any.
AskedVertices ask_vertices(const Graph& points, std::span<const float> positions, const Numbering& point,
                           std::span<const std::uint8_t> hanging, std::size_t samples, Workers& workers);

// The areas of the vertices in the territory of each of so many samples, base samples and added ones; 0 where
// none of them was asked. The same for any number of workers.
std::vector<double> territory_areas(const AskedVertices& asked, const ChangingTerritories& territories,
                                    std::size_t samples, Workers& workers);

} // namespace knead

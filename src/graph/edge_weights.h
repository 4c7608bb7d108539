#pragma once
// How much each link of the sample graph counts.

#include "base/workers.h"
#include "graph/csr.h"

#include <span>
#include <vector>

namespace knead {

// Weights under which the graph's Laplacian stands for the surface's, however the surface was sampled.
//
// They begin as those of a finite-volume scheme, w_ij = contact_ij / |e_ij|, the border that two territories
// share over the distance of their middles. A few multiplicative updates then make each vertex pull evenly in
// all the directions that it has links in, until Σ_j w_ij e_ij e_ijᵀ looks the same along each of them, in
// the tangent plane of a surface as well as throughout a solid:
//
//     w_ij ← w_ij · mean_k(d_ikᵀ C_i d_ik) / (d_ijᵀ C_i d_ij),  C_i = Σ_j w_ij e_ij e_ijᵀ,  d = e/|e|.
//
// Each vertex's weights have the mean 1, and the two directions of a link are averaged. Uniform weights
// instead make a cloud stiff across the lines that it was sampled along, and the survey's cylinder creases.
//
// `position` and `contact` > 0: one entry a vertex, and one for every entry of graph.neighbor, the same in
// both directions; so is the result, > 0.
std::vector<double> isotropic_weights(const Graph& graph, std::span<const Vec3d> position,
                                      std::span<const float> contact, Workers& workers);

} // namespace knead

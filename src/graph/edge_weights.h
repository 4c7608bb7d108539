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
// share over the distance of their middles. Two things are then asked of them, and met as far as the links
// allow. Each vertex pulls evenly in all the directions that it has links in: Σ_j w_ij e_ij e_ijᵀ looks the
// same along each of them, in the tangent plane of a surface as well as throughout a solid, by a few
// multiplicative updates
//
//     w_ij ← w_ij · mean_k(d_ikᵀ C_i d_ik) / (d_ijᵀ C_i d_ij),  C_i = Σ_j w_ij e_ij e_ijᵀ,  d = e/|e|.
//
// And its pulls cancel, Σ_j w_ij e_ij = 0 along the surface, by
//
//     w_ij ← w_ij (1 - e_ijᵀ C_i⁺ Σ_k w_ik e_ik),
//
// the smallest relative change that does it: then linear functions are harmonic, an even stretch is in
// balance, and an irregular cloud answers a pull like a regular one. On a border the pulls cannot cancel: a
// vertex is left as it is where |Σ w e| exceeds a bound times Σ w |e|, and begins to be at 0.2 less. Along
// an evenly sampled straight border this is 2/π. Samples of territories lie inside the border, by half their
// distance more or less, and need a low bound, 0.3; for points that go as far as the surface does 0.5 will
// do.
//
// Each vertex's weights have the sum 6 c, and the two directions of a link are averaged, after every update
// of the second kind. c = 1 - π/4 · |Σ w e| / Σ w |e|, of the weights in the beginning, is the share of all
// directions that the surface goes on in, one half on a straight border: the sum over a Voronoi cell's sides
// of contact over distance is half of the angle that the cell fills, whether it has five sides or seven, and
// a vertex with more links than its neighbours must not be stiffer for it. (On the face of a solid it is a
// little more than the half that is there.) Uniform weights instead make a cloud stiff across the lines that
// it was sampled along, and the survey's cylinder creases.
//
// `area` says for how much of the surface each vertex stands, be it a point (vertex_areas.h) or a sample of
// many (territory_areas.h): its weights then have that sum which makes Σ_j w_ij |e_ij|² come to it. The
// lengths of its own links tell that only roughly where points lie at random, where the surface is a thin
// limb or a rim, or denser here than there, and the cloud would be softer at one place and stiffer at
// another. And where pulls are left that do not cancel, as they are the more the more at random points lie, a
// point's sum is a little more: such vertices yield when all is stretched evenly, and the surface would
// resist less than by its area. (Samples keep apart, and the few pulls that they leave are of limbs' ends and
// rims, which nothing is to be added to.)
//
// `position` and `contact` > 0: one entry a vertex, and one for every entry of graph.neighbor, the same in
// both directions; so is the result, > 0. `area`: one entry a vertex, 0 where it is not known; or empty.
struct WeightsOf {
    double border;  // the bound
    bool may_yield; // and get more for it
};
inline constexpr WeightsOf of_points{0.5, true}, of_territories{0.3, false};
std::vector<double> isotropic_weights(const Graph& graph, std::span<const Vec3d> position,
                                      std::span<const float> contact, const WeightsOf& of,
                                      std::span<const double> area, Workers& workers);

} // namespace knead

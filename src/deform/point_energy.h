#pragma once
// The energy of the points between few samples, as a function of the samples alone.
//
// Where samples are few, a graph between them is a poor likeness of the surface. But how every point follows
// is known (upsample/upsample.h): with the bodies s, which are samples and handles, p' = p + Σ_s w_s u_s +
// Σ_s A_s (w_s c_s), with A_s p + b_s what a body does to the point and c_s the way to it, halfway along arcs
// where the weights are smooth. So the displacement's gradient along the surface is linear in what the bodies
// do,
//
//     D = Σ_s u_s g_sᵀ + Σ_s A_s H_s,    g_s = ∇w_s,  H_s = ∇(w_s c_s),
//
// and so is what it should be, A̅ P = Σ_s v_s M_s P, with M_s the turns (and elastic targets) beyond the
// identity and P the surface's projection. The energy of sample_system.h over the points, Σ ω |D - A̅ P|² +
// β Σ ω |∇r|², restricted to shapes that so few samples can make, is then a sum over pairs of bodies, whose
// coefficients are sums over points: Galerkin's method, with the blends of the samples as the finite
// elements. The turns' own weights v_s, in the place of w_s in A̅, are w_s, but beside and in a handle that
// leaves rotation free: where it has samples that are asked like others, they turn as the surface there
// wants, each for itself, and the handle has no share in turns. It moves the points that it holds alone,
// though. (Reduced deformables by frames: B. Gilles, G. Bousquet, F. Faure, D. Pai, "Frame-based elastic
// models", 2011; by blended handles: A. Jacobson and others, "Fast automatic skinning transformations",
// 2012.) The fixed point is then nearer to that of every point a sample than by links alone (knead
// evaluate).
//
// Blends of constants are no linear functions, they climb in steps. For the turns, which have no slope of
// their own in a sample, that would count as resistance; so their gradients are ĝ_s = G⁻ᵀ ∇v_s, with G =
// Σ_s p_s ∇v_sᵀ what the blend makes of the positions themselves: linear in the place, turns have no more
// slope than they should. (Balanced weights, graph/balanced_weights.h, have a G near the identity already.)
//
// Handles want turned what they turn, R, not stretched what they stretch, A - R: the surface beyond is not
// theirs. But what lies within them is, as of the links of samples (sample_system.h): a body of its own wants
// A - R at their points and beside them, to the part φ of the squares of the links there that lies within,
// all of those between two held vertices and half of those that lead out. It moves nothing.
//
// Gradients are those of least squares over the neighbours of a point. ω = 3/dim · a h² c stands for the
// surface around it, with h² the mean square length of its links, c its share of all directions
// (graph/edge_weights.h), a what these fall short of its area (graph/territory_areas.h), and dim = tr P; so
// that Σ ω matches what links add up to when every point is one.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/influences.h"
#include "graph/point_order.h"
#include "graph/vertex_labels.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// What two bodies t and s have to do with each other; t is a sample. In the matrices, and for the positions:
struct BodyPair {
    double way = 0;                     // Σ ω g_t·g_s
    double turn = 0;                    // Σ ω ĝ_t·ĝ_s
    Vec3d map_force = Vec3d::Zero();    // Σ ω H_s g_t
    Vec3d target_force = Vec3d::Zero(); // Σ ω v_s P g_t
};

// And for the turns. (Each step reads but one of the two, and takes as long as reading takes.)
struct PairSlopes {
    Vec3d way_slope = Vec3d::Zero();     // Σ 2ω v_t g_s
    Mat3d map_slope = Mat3d::Zero();     // Σ 2ω v_t H_s
    Mat3d target_spread = Mat3d::Zero(); // Σ 2ω v_t v_s P
};

// And for what a sample's map should be (deform/fitted_maps.h), besides Σ ω H_s H_tᵀ.
struct PairFits {
    Vec3d way = Vec3d::Zero();    // Σ ω H_t g_s
    Mat3d target = Mat3d::Zero(); // Σ ω v_s P H_tᵀ
};

struct PointEnergy {
    double share = 1;        // that it has of the whole energy, 0 … 1; links have the others'
    std::size_t samples = 0; // bodies below are samples, then come the handles, and what they grow by
    std::size_t bodies = 0;

    std::size_t handles() const { return (bodies - samples) / 2; }
    std::vector<Index> first; // one entry a sample, and the end; empty: no energy
    std::vector<Index> body;  // of each pair: s, ascending within t, which is among them
    std::vector<BodyPair> pair;
    std::vector<PairSlopes> slopes; // of each pair
    std::vector<PairFits> fits;
    std::vector<Mat3d> map_products; // Σ ω H_s H_tᵀ
    std::vector<Mat3d> spread;       // Σ 2ω v_t P, of each sample
    std::vector<double> confidence;  // Σ 2 dim ω v_t, of each sample
};

// The cloud between the samples.
struct PointsBetween {
    const Graph& graph;               // of the vertices
    std::span<const float> positions; // 3n at rest, of the points
    const Numbering& point;           // of each vertex: one of its points
    std::span<const Index> asked;     // vertices, ascending, that tell of all
    std::span<const double> each;     // of these: for how many it stands
    const InfluenceRows& nearest;     // of each vertex
    InfluenceWeights weights;
    std::span<const float> area_of_links;  // of each base sample: what the area of points that are nearest to
                                           // it is of what their links tell; empty: 1
    std::span<const std::uint8_t> hanging; // of each vertex: 1 for an outlier, which says nothing of the
                                           // surface; empty without any
    std::span<const Index> label;          // of each vertex: its handle, or no_index
    const std::vector<bool>& turns_freely; // of each handle: whether it says where its points go, but not
                                           // how they turn; may end early
    std::vector<bool> turns_by_samples;    // of each handle: whether it is one of these, and samples that it
                                           // holds are in the rows around; may end early
    std::span<const Vec3d> sample;         // rest positions
    std::size_t handles;                   // handle h is body sample.size() + h, and what it grows by the
                                           // one so many later
};

// How much of the energy is that of the points, 0 … 1, where so many samples are chosen among so many
// vertices: all where samples are few, less and less of more, and nothing of many, which links are near
// enough for; sooner where a sample stands for a few points only, as there is hardly anything to sum up
// between them. It fades, so that some samples more make no other shape.
double share_of_points(std::size_t samples, std::size_t vertices);

// Sums up over the vertices that are asked, but those that one handle moves with all their neighbours:
// nothing changes there. The same for any number of workers.
PointEnergy point_energy(const PointsBetween& between, Workers& workers);

// All of it so many times, but for what says how maps fit, for which that is all the same.
void scale(PointEnergy& energy, double times);

} // namespace knead

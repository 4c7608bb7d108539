#pragma once
// What the bodies of a PointEnergy do, and what those around a sample add to an iteration: sums over some
// ten thousand pairs, so they are made by four numbers at once.

#include "deform/fours.h"
#include "deform/point_energy.h"

#include <span>

namespace knead {

// What a body does: it sends p to p + map p + way, or, a sample, about its place.
struct Body {
    alignas(32) Four way = {};
    Columns map;           // A - I
    Columns turn;          // M - I: R S - I
    bool placed = true;    // given, not to be solved for: `way` ...
    bool turned = true;    // ... and how it turns
    Index from = no_index; // of a handle: one of its samples
};

// The pairs of one sample, and their bodies' numbers in `all`.
struct BodiesAround {
    std::span<const BodyPair> pair;
    std::span<const PairSlopes> slopes;
    std::span<const PairFits> fits;
    std::span<const Mat3d> map_products;
    std::span<const Index> body;
    std::span<const Body> all;
};
BodiesAround bodies_around(const PointEnergy& energy, std::span<const Body> all, Index sample);

// Σ_s u_s (Σ 2ω v_t g_s)ᵀ + (A_s - I) Σ 2ω v_t H_s - γ (M_s - I) Σ 2ω v_t v_s P: what they add to the sum of
// step 1 of sample_system.h. γ: `midway`.
Mat3d local_sum_of(const BodiesAround& around, double midway);

// Σ_s (M_s - I) Σ ω v_s P g_t - (A_s - I) Σ ω H_s g_t, and for those that are placed less u_s Σ ω g_t·g_s:
// what they add to the right-hand side of step 3.
Vec3d force_of(const BodiesAround& around);

// Σ_s (M_s - I) Σ ω v_s P H_tᵀ - (A_s - I) Σ ω H_s H_tᵀ - u_s (Σ ω H_t g_s)ᵀ: what the right-hand side of
// deform/fitted_maps.h is, with the A of samples what maps are before they are fitted.
Columns misfit_of(const BodiesAround& around);

} // namespace knead

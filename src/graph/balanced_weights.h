#pragma once
// Weights that reproduce places, as nearly as rows allow.
//
// The weights of influences.h fall with the distance along the surface and know no directions: the mean of
// the samples' places by them, p̄ = Σ_s w_s p_s, is anywhere near the point p. What moves points
// (upsample/upsample.h) takes a linear field right for all that; one that bends it misses by the bend times
// |p - p̄|², which goes up and down from sample to sample and shows as ripples. So weights are balanced about
// the point,
//
//     w_s ← w_s (1 + ½ β·(p_s - p̄))₊²,   β = (C + (λ r² + κ |p - p̄|²) I)⁻¹ (p - p̄),
//     C = Σ_s w_s (p_s - p̄)(p_s - p̄)ᵀ,   r² the mean of |p_s - p|² over all places of the row,
//
// with Σ w_s = 1 before, and up to a common factor after. To first order in β and without what is added to C
// that is the correction of W. K. Liu, S. Jun, Y. F. Zhang, "Reproducing kernel particle methods", 1995: p̄
// comes to p. It is squared, and 0 from where the sum is, as no weight may be negative. What is added keeps
// weights as they are where they cannot be balanced: across the surface, where samples lie in a plane; where
// one sample has nearly all the weight; and at rims, where all samples are on one side and the more they lean
// towards the point the fewer of them count.
//
// r² counts all places alike, so where another one becomes the farthest, at weight 0, weights change by a
// thousandth or so. With r² weighted by w they would not; nothing that is measured is better for it (knead
// evaluate, λ = 0.1).
//
// A place that is the point itself, as all handles have it, pulls nowhere.

#include "graph/influences.h"

#include <array>
#include <span>

namespace knead {

// λ. Less of it reproduces places better, and samples that stand in a lattice stick out as dots.
inline constexpr float balance_ridge = 0.05F;

// κ. Less of it reproduces places better where they are far off, and there makes scans with few samples more
// uneven and, with 200 samples, an auxetic tube too wide (knead evaluate, the room and elasticity).
inline constexpr float balance_caution = 3.0F;

// p_s - p of each place of a row, in any unit; 0 where there is no p_s.
struct SampleOffsets {
    alignas(32) std::array<float, influences_per_row> x{}, y{}, z{};
};

// As seen from p. `places`: p_s of each sample. What has a number beyond them is where p is: handles, and
// empty places.
template<typename Number>
SampleOffsets offsets_from(const Vec3d& p, const SampleRow<Number>& row, std::span<const Vec3d> places) {
    SampleOffsets offsets;
    for (std::size_t k = 0; k < influences_per_row; ++k) {
        if (row.sample[k] >= places.size()) continue;
        const Vec3d offset = places[row.sample[k]] - p;
        offsets.x[k] = static_cast<float>(offset.x());
        offsets.y[k] = static_cast<float>(offset.y());
        offsets.z[k] = static_cast<float>(offset.z());
    }
    return offsets;
}

// Balances weights, which are 0 or more, up to a common factor, and so they stay. Those that cannot be
// (there is but one place, or offsets whose squares are no numbers) stay as they are.
void balance(const SampleOffsets& offsets, std::array<float, influences_per_row>& weight);

// Like those of influences.h, with smooth weights balanced: by a row seen from a point, and by the number of
// what moves the point p.
Influence influence_of(const WideRow& row, Index first_handle, InfluenceWeights weights,
                       const SampleOffsets& offsets);
Influence influence_of(const InfluenceRows& rows, InfluenceWeights weights, std::span<const Vec3d> places,
                       Index number, const Vec3d& p);

} // namespace knead

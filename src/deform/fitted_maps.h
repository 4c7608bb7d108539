#pragma once
// What few samples do to the points around them, beyond turning with them.
//
// A sample sends the points around it by its map A (deform/point_energy.h). By its turn alone, A = M, it
// would lay what is between it and the next ones straight where the surface is bent, and even where it is
// stretched: the more so, the farther apart samples are, and from one point to the next by as much as each of
// them has a share in these. So maps are fitted to the points: with all places and turns as they are, those
// make
//
//     Σ ω |D - M̅ P|² + Σ_t λ_t |A_t - A⁰_t|²,    A⁰ = q r* S + (1 - q) F,
//     λ_t = λ/(3 q⁴) max(tr Σ ω H_t H_tᵀ, κ tr Σ 2ω v_t P)
//
// least: the energy of the points, and a preference for what maps are without it where no point tells. q is
// the share that this energy has of the whole (share_of_points(), and less for soft sheets). Where it fades,
// maps go over to what links say of the surroundings of each sample, F; and sooner, by q⁴, since where but
// one point or two lie between samples these have maps that no point holds (a wire of 60 points, 40 of them
// samples, folded when it was pressed). κ is what the first is of the second for most samples, or less: one
// that moves hardly any point but its own has next to nothing of the first, and a map that is anything, which
// flings outliers that hang there out of the cloud. With A = A⁰ + X the X of all samples that turn by
// themselves solve
//
//     Σ_s X_s Σ ω H_s H_tᵀ + λ_t X_t = Σ_s M_s Σ ω v_s P H_tᵀ - A⁰_s Σ ω H_s H_tᵀ - u_s (Σ ω H_t g_s)ᵀ,
//
// handles having their maps for A⁰. Conjugate gradients, preconditioned by each sample's own block, are near
// enough after two steps: with one some scans do not come to rest, and with more of them knead evaluate shows
// no less unevenness. (Degrees of freedom of this kind, and their energy: Gilles and others, as there.)
//
// The maps turn as the links of a sample do, by r*, not by its own R: where a turn takes up little of the
// cloud R lags behind, and normals with it (deform/stretch.h).
//
// Of the stretches U that links between samples tell, which made A = R U before, few samples see too little:
// the bent dragon with 50 of them was 1.48 times as uneven as with every point a sample, and is 1.30 times
// so; the survey's cylinder took 112 iterations to come to rest, and takes 38 (knead evaluate).

#include "base/workers.h"
#include "deform/fours.h"

#include <vector>

namespace knead {

struct SampleState;
struct SampleSystem;

// The work space of it, prepared once a system. An entry each row of the system, but for `step`.
struct MapFit {
    std::vector<double> preference; // λ_t
    std::vector<Mat3d> inverse;     // (Σ ω H_t H_tᵀ + λ_t)⁻¹; 0 where no point tells
    std::vector<Columns> found;     // X
    std::vector<Columns> residual, product;
    std::vector<Columns> step; // of each sample; 0 where its map is given
    std::vector<double> sums;  // of each chunk of rows
};

// Makes the work space ready for what the system's energy says. Without any it stays empty, and where q is
// less than one half: λ/q⁴ would leave next to nothing to be fitted.
void prepare_fit(SampleSystem& system);

// Fits the maps of all samples that turn by themselves: adds Rᵀ X to system.stretch, which must be Rᵀ A⁰ - I,
// and system.body what all bodies do by that. Exactly zero where nothing moves. Allocates nothing of its own.
void fit_maps(SampleSystem& system, const SampleState& state, Workers& workers);

} // namespace knead

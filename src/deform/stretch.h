#pragma once
// How a sample's surroundings were stretched, and how an elastic material answers.
//
// Let A = Σ_j w_ij (x_j - x_i) e_ijᵀ and Σ = Σ_j w_ij e_ij e_ijᵀ over the edges of a sample. Where the edges
// determine it, the deformation gradient is F = A Σ⁻¹. On a surface the edges leave the direction across it
// open, and on a wire two; there F turns as they do, with the rotation r* that is nearest to A:
//
//     F = A Σ⁺ + r* (I - Σ Σ⁺).
//
// The sample's own rotation R lags behind where a turn takes up less of the cloud than √α of its size: F
// would shear the surface by as much, and stand relief and normals askew on it.
//
// The material is Hooke's law in Hencky's strain h = ½ log FᵀF: in units of its stiffness under a change of
// one principal strain alone,
//
//     σ = (1 - ν′) h + ν′ tr(h) P,   ν′ = ν on a surface (plane stress), ν/(1 - ν) in a solid,
//
// with P = Σ Σ⁺ what the edges determine and ν Poisson's ratio, the ratio of contraction across to
// elongation along, both as logarithms, of a strip that is pulled and free at its sides (σ = 0 across). The
// iteration pulls every edge towards R S e_ij with
//
//     S = exp(h - a σ),
//
// so that its residual F - R S stands for the stress, and a shape in which nothing is pulled any more has
// σ = 0, whatever a is; a ≤ 1 only keeps the steps from overshooting. For ν = 0 it is S = I: Equation (2).
//
// Edges between points that lie by chance lean to one side, Σ_j w_ij e_ij ≠ 0. A stress H - S, the same
// everywhere, then makes forces (H - S) Σ w e, to which samples give way: as a whole, edges resist the strain
// H by (1 - c)(H - S) only, and what a sample sees of it is h = H - c (H - S), where c is the part of Σ w
// |e|² that gives way. With M for what makes σ of h above and λ = c/(1 - c) the whole obeys M (I + λM)⁻¹ in
// the place of M: a ratio of ν/(1 + λ(1 - ν²)) on a surface. So it is
//
//     S = exp(h - a M (I - a λM)⁻¹ h),
//
// which makes the whole obey a M; a = 1/(1 + λ), as S = I does, or less where h is answered by more than 5/3
// of it.

#include "base/types.h"

namespace knead {

// What the edges of a sample determine at rest.
struct Surroundings {
    Mat3d inverse = Mat3d::Zero();  // Σ⁺
    Mat3d open = Mat3d::Identity(); // I - Σ Σ⁺, symmetric
    double thickness = 0;           // 0: a surface or a wire, 1: a solid
    double looseness = 0;           // λ ≥ 0 (deform/looseness.h): 0 where edges give way as one
};

// Of Σ. A direction counts as determined where the spread along it is comparable with the largest, and
// fades out where it is not, so that a surface that curves or is noisy does not become a solid at once.
Surroundings surroundings_of(const Mat3d& spread);

// F - I of Σ_j w_ij (u_j - u_i) e_ijᵀ, with u the displacements, and r* - I. Exactly zero where both are.
Mat3d gradient_of(const Surroundings& surroundings, const Mat3d& displaced, const Mat3d& turn);

// S - I for F - I and Poisson's ratio, -1 < ν < 0.5. Exactly zero for a rotation by nothing, and for ν = 0.
// Strains beyond a factor of e² count as e².
Mat3d elastic_target(const Surroundings& surroundings, const Mat3d& gradient, double poisson);

} // namespace knead

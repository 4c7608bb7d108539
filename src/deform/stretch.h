#pragma once
// How a sample's surroundings were stretched, and how an elastic material answers.
//
// Let A = Σ_j w_ij (x_j - x_i) e_ijᵀ and Σ = Σ_j w_ij e_ij e_ijᵀ over the edges of a sample. Where the edges
// determine it, the deformation gradient is F = A Σ⁻¹. On a surface the edges leave the direction across it
// open, and on a wire two; there F turns as the sample does:
//
//     F = A Σ⁺ + R (I - Σ Σ⁺).
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
//     S = exp(h - σ/κ),
//
// so that its residual F - R S stands for the stress, and a shape in which nothing is pulled any more has
// σ = 0, whatever κ is; κ ≥ 1 only keeps the steps from overshooting. For ν = 0 it is S = I: Equation (2).

#include "base/types.h"

namespace knead {

// What the edges of a sample determine at rest.
struct Surroundings {
    Mat3d inverse = Mat3d::Zero();  // Σ⁺
    Mat3d open = Mat3d::Identity(); // I - Σ Σ⁺, symmetric
    double thickness = 0;           // 0: a surface or a wire, 1: a solid
};

// Of Σ. A direction counts as determined where the spread along it is comparable with the largest, and
// fades out where it is not, so that a surface that curves or is noisy does not become a solid at once.
Surroundings surroundings_of(const Mat3d& spread);

// F - I of Σ_j w_ij (u_j - u_i) e_ijᵀ, with u the displacements, and R - I of the sample. Exactly zero where
// both are.
Mat3d gradient_of(const Surroundings& surroundings, const Mat3d& displaced, const Mat3d& turn);

// S - I for F - I and Poisson's ratio, -1 < ν < 0.5. Exactly zero for a rotation by nothing, and for ν = 0.
// Strains beyond a factor of e² count as e².
Mat3d elastic_target(const Surroundings& surroundings, const Mat3d& gradient, double poisson);

// U - I, where F = R U is the polar decomposition.
Mat3d stretch_of(const Mat3d& gradient);

} // namespace knead

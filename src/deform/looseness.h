#pragma once
// How much the links of scattered samples give way, for the elastic target (deform/stretch.h).

#include "deform/sample_system.h"

namespace knead {

// λ of every row for the system's ν, in `surroundings` and `with_points`, once the system is built.
//
// Under a stress that is the same everywhere, Σ_j w_ij e_ij pushes a sample to where most of its links point.
// These pushes f, the same for each of three stresses, are let go for twenty steps of Jacobi's method towards
// L u = f; what is given away is f·u, and that in parts of Σ w |e|² around a sample, points between counted
// in, is what would give way if targets stayed. What all neighbours are pushed as well is left out, as at a
// rim, where the whole gives way and not single samples. But targets follow the strains that arise, and
// resist them the less the softer the material is, in the mean of its three stiffnesses on a surface 1/(1 +
// ν) and twice 1/(1 - ν): c is 2.5 times as much as that. That factor alone is fitted, so that Poisson's
// ratio of scattered points is what is asked for (tests/edit/rubber_test.cpp).
void find_looseness(SampleSystem& system, Workers& workers);

} // namespace knead

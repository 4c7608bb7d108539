#pragma once
// Iterations that learn from the ones before: Anderson's acceleration of the fixed point.

#include "deform/sample_system.h"

#include <cstddef>
#include <vector>

namespace knead {

// What the last iterations told, of the displacements of the samples that have a free position, and, where
// the next iteration depends on them (γ > 0), of all free rotations. One of these goes with a sequence of
// iterations at unchanging poses, from its first to its last.
struct Acceleration {
    static constexpr std::size_t most_remembered = 5;

    std::size_t remembered = 0; // of the two below, the newest in turn at `next`
    std::size_t next = 0;
    std::vector<double> result_steps;     // most_remembered columns: G(u) of an iteration less the one before
    std::vector<double> residual_steps;   // likewise of G(u) - u
    std::vector<double> result, residual; // of the last iteration; empty before the first
    std::vector<double> now, before;      // work space

    // With a coarse level (coarse_level.h): how it did so far.
    bool alone = false;      // it did not help any more: iterations go on without
    double last_way = 0;     // of the iteration before; 0 before the first
    int stalled = 0;         // iterations that went hardly less far than the one before
    SampleState uncorrected; // where that one led to by itself
};

// Forgets everything, and keeps the memory: the poses change.
void forget(Acceleration& acceleration);

// One iteration, as iterate() does, and then the combination with the last ones whose residual is the
// smallest by least squares (D. G. Anderson, "Iterative procedures for nonlinear integral equations", 1965;
// with the differences as in H. F. Walker and P. Ni, "Anderson acceleration for fixed-point iterations",
// 2011): with G(u) what iterate() makes of the displacements u, f = G(u) - u and Δ the differences of
// succeeding iterations,
//
//     u ← G(u) - ΔG θ,   θ = argmin |f - ΔF θ|.
//
// Where γ > 0, u has the quaternions too, times ℓ, so that what they do to the links counts as much as what
// displacements do. As long as no more than two differences are known, ΔG θ is held to 1.5 |f|: the few
// iterations of a drag's frame know too little of a shape that is twisted so far that it might buckle. Where
// an iteration has more than twice the residual of the one before, everything is forgotten, and its own
// result stands. Allocates in its first two iterations only. Returns the longest way of a sample in the plain
// iteration.
double iterate(SampleSystem& system, std::span<const HandleMotion> handles, SampleState& state,
               Acceleration& acceleration, Workers& workers);

} // namespace knead

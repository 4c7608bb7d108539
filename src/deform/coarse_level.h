#pragma once
// Few samples that take the many along: what makes the iteration converge.
//
// An iteration of sample_system.h hands turns on from sample to sample, so a limb on a thin neck takes many
// of them to come round as a whole. A second, coarse set of samples, chosen among those that there are, needs
// hardly any time for its own iterations and finds out where the limb goes. This is the full approximation
// scheme (A. Brandt, "Multi-level adaptive solutions to boundary-value problems", 1977) for a fixed point
// u = G(u): with u the displacements before an iteration, G(u) after it, I their values at the coarse samples
// and G_c the coarse samples' own iteration,
//
//     v = G_c(v) + τ,   τ = I G(u) - G_c(I u),
//
// is solved for v by some accelerated iterations, and every sample follows the coarse ones around it by the
// weighted mean of their motions, what took them from I G(u) to v. Where nothing is left to do, G(u) =
// u, the solution is v = I u and nothing moves: the fixed point is that of the fine iteration, whatever the
// coarse one would make of the shape. For that G_c must be one of displacements alone: γ = 0 there. (The fine
// G hangs on the rotations before it as well; they are carried along, and τ takes G(u) as it came out.)

#include "deform/acceleration.h"
#include "deform/coarse_samples.h"
#include "deform/sample_system.h"

#include <vector>

namespace knead {

struct CoarseLevel {
    CoarseSamples samples;
    SampleSystem system;       // of the coarse samples; its `shift` is τ
    SampleState state;         // work space: v
    std::vector<Quatd> turn;   // how the coarse samples are turned at I G(u), then the turn from there to v
    std::vector<Vec3d> before; // I u, then I G(u)
    std::vector<Eigen::Matrix<double, 3, 4>> motion; // of each coarse sample: [R - I | b], about the origin
    Acceleration acceleration;
};

// Builds the system of the coarse samples; again whenever that of all samples was, which comes first. Where
// the outcome is bad there is no coarse level; but for want of memory, which the caller has to refuse.
FactorOutcome build_coarse_level(const SampleSystem& fine, CoarseLevel& coarse, Workers& workers);

// One iteration as iterate() does it, corrected by what the coarse samples make of it. The coarse samples are
// given up, and iterations accelerated without them until `memory` forgets, in two cases:
//   - an iteration goes farther than the one before: they do not know better here (a bar that is about to
//     buckle, a very elastic one). What they made of the one before is taken back.
//   - four iterations in all have gone more than .8 times as far as the one before them: they do not pay.
// `memory` goes with a sequence of iterations at unchanging poses. Allocates in the first two iterations, and
// in the first two without the coarse samples. Returns the longest way that a sample went in the plain
// iteration.
double iterate(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
               SampleState& state, Acceleration& memory, Workers& workers);

// --- Drags of so many samples that iterations of all of them cannot follow the hand ---
//
// Then the coarse samples answer alone, and the others are carried along from where they were when this
// began, the anchor. τ is that of the anchor, turned along with each coarse sample: a handle that hardly
// moves moves nothing but what it would have, and iterations of all samples go on from there as from any
// other state.

struct CoarseFollowing {
    bool anchored = false;          // the rest is empty else
    SampleState anchor;             // of all samples
    SampleState coarse_anchor;      // of the coarse ones, as they have it
    std::vector<Mat3d> from_anchor; // of each coarse sample: the inverse of how its surroundings were moved
    std::vector<Vec3d> shift;       // τ, of each of their moving rows
    SampleState now;                // of the coarse samples
};

// Makes a state the anchor, which is first iterated once more (to know τ). `handles`: as they were when the
// state was computed.
void anchor(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
            SampleState& state, CoarseFollowing& following, Workers& workers);

// A frame: what follow_handles() and iterations make of the coarse samples, from where they were in the frame
// before, and all samples carried along. `iterations`: that a frame of all samples would have; of coarse ones
// there may be four times as many, as long as something is left to do. Allocates in its first two calls only.
// Returns the longest way that a coarse sample went in the last iteration.
double follow_coarsely(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
                       unsigned iterations, CoarseFollowing& following, SampleState& state, Workers& workers);

} // namespace knead

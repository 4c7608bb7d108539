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
// is solved for v by some accelerated iterations, and every sample follows the coarse ones around it as
// rigidly as points follow samples, by what took them from I G(u) to v. Where nothing is left to do, G(u) =
// u, the solution is v = I u and nothing moves: the fixed point is that of the fine iteration, whatever the
// coarse one would make of the shape.

#include "deform/acceleration.h"
#include "deform/sample_system.h"
#include "graph/sampling.h"

#include <vector>

namespace knead {

// Which samples are coarse, and who follows them.
struct CoarseSamples {
    std::vector<Index> sample; // of each coarse sample, the sample that it is
    SampleGraph between;       // the coarse samples
    std::vector<Influence>
        followed;               // of each sample: the coarse ones around it, and how much it follows each
    std::vector<Index> nearest; // of each sample, the coarse one nearest to it, or no_index
};

struct CoarseLevel {
    CoarseSamples samples;
    SampleSystem system;       // of the coarse samples; its `shift` is τ
    SampleState state;         // work space: v
    std::vector<Quatd> turn;   // how the coarse samples are turned at I G(u), then the turn from there to v
    std::vector<Vec3d> before; // I u, then I G(u)
    std::vector<Eigen::Matrix<double, 3, 4>> motion; // of each coarse sample: [R - I | b], about the origin
    Acceleration acceleration;
};

// Whether so many samples gain by a coarse level.
bool wants_coarse_level(std::size_t samples);

// Chooses the coarse samples, some two hundred of them or one in fifty. `graph`: between the samples;
// `position`, `handle`: of each sample, as in SampleRest.
CoarseSamples coarse_samples(const Graph& graph, std::span<const Vec3d> position,
                             std::span<const Index> handle, Workers& workers);

// Builds the system of the coarse samples; again whenever that of all samples was, which comes first. Where
// the outcome is bad there is no coarse level.
FactorOutcome build_coarse_level(const SampleSystem& fine, CoarseLevel& coarse, Workers& workers);

// One iteration as iterate() does it, and what the coarse samples make of it. An iteration that goes farther
// than the one before shows that they do not know better here (a bar that is about to buckle, a very elastic
// one): then what they made of the one before is taken back, and until `memory` forgets, iterations are
// accelerated without them. `memory` goes with a sequence of iterations at unchanging poses. Allocates in its
// first two iterations only. Returns the longest way that a sample went in the plain iteration.
double iterate(SampleSystem& fine, CoarseLevel& coarse, std::span<const HandleMotion> handles,
               SampleState& state, Acceleration& memory, Workers& workers);

} // namespace knead

#pragma once
// Which of the samples are coarse ones, and how the others follow them: the places that coarse_level.h
// computes with.

#include "base/workers.h"
#include "graph/influences.h"
#include "graph/sampling.h"

#include <span>
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

// Whether so many samples gain by a coarse level.
bool wants_coarse_level(std::size_t samples);

// Chooses the coarse samples, some two hundred of them or one in fifty. `graph`: between the samples;
// `position`, `handle`: of each sample, as in SampleRest.
CoarseSamples coarse_samples(const Graph& graph, std::span<const Vec3d> position,
                             std::span<const Index> handle, Workers& workers);

} // namespace knead

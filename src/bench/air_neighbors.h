#pragma once
// What Figure 2 of the paper warns of: points that follow the samples nearest through the air, instead of
// those nearest along the surface. For comparison only; knead never does it.

#include "edit/pipeline.h"

#include <vector>

namespace knead {

// The points of a pipeline's cloud, 3n in its order, as its samples move them when the eight that are nearest
// in space count, with smooth weights. Points that handles hold, and parts without a handle, go where they
// should. Links between samples are those along the surface all the same. `motions`: one a handle; O(n m).
std::vector<float> posed_through_the_air(const Pipeline& pipeline, const std::vector<HandleMotion>& motions,
                                         const SampleState& state, Workers& workers);

} // namespace knead

#pragma once
// A pipeline without a document: one frame of it, and which parts of the cloud its handles hold.

#include "edit/pipeline.h"

#include <memory>
#include <vector>

namespace knead {

// A handle's points (of the file) as a pipeline takes them.
std::shared_ptr<const std::vector<Index>> shared_points(std::vector<Index> points);

// One frame from the rest pose, on a prepared pipeline: the samples follow the handles, so many iterations,
// and all points. `motions`: one a handle. Returns where the samples are then; the points are
// pipeline.posed().
SampleState pose_from_rest(Pipeline& pipeline, const std::vector<HandleMotion>& motions, unsigned iterations);

// Of each part that hangs together (pipeline.components()): whether a handle holds any of it.
std::vector<bool> held_parts(const Pipeline& pipeline);

} // namespace knead

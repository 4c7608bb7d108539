#pragma once
// Two handles that fit any cloud, for measurements: one at each end of its longest side.

#include "cloud/point_cloud.h"
#include "edit/handles.h"

#include <vector>

namespace knead {

// The points of the lowest and of the highest 15 % of the bounding box along its longest side, and a pivot
// and an axis to turn the upper ones about: the middle of the box, and the second longest side, which bends
// the cloud. Coordinates are the file's.
struct AutomaticHandles {
    std::vector<Index> fixed, moving; // ascending
    Vec3d pivot = Vec3d::Zero();
    Vec3d axis = Vec3d::UnitX();
};

// The cloud has a finite point. Where all points lie in one place, both handles hold all of them.
AutomaticHandles automatic_handles(const PointCloud& cloud);

// A turn about the axis through the pivot.
HandlePose bent_by(const AutomaticHandles& handles, double degrees);

// The line of a session that declares a handle of these points (ascending).
HandleLine handle_line(const std::string& name, HandleRole role, const std::vector<Index>& points);

} // namespace knead

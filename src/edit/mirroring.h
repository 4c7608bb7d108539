#pragma once
// The other side of a cloud: where the plane lies across which it is most like its own mirror image, and
// which points are a handle's there.

#include "edit/editor.h"
#include "edit/reflection.h"

#include <span>
#include <vector>

namespace knead {

struct MirrorPlane {
    int axis = 0;          // 0, 1, 2: across x, y, z
    double at = 0;         // along it, relative to the cloud's origin
    bool is_middle = true; // whether that is the middle of the bounding box
};

// Looks for the plane a third of the box to both sides of its middle. Scans are seldom cut off evenly, and a
// head that is turned moves the box but not what it sits on. The middle it is where no place is clearly
// better. `positions`: 3n; `spacing`: the usual distance between neighbouring points. Time is that of 20,000
// points at most.
MirrorPlane mirror_plane(std::span<const float> positions, int axis, double spacing);

// A handle's part on the other side.
struct PartAcross {
    std::vector<Index> points;   // of the file, ascending; empty: there is none
    Vec3d shift = Vec3d::Zero(); // how far off its mirror image it stands
};

// The points whose mirror image lies nearest to a point of the handle, in the shape of these `positions` (3n,
// in the order of computation); nothing farther off than `reach` counts. Where that finds less than half of
// the handle's points, as a leg that is set forward has nothing across it, the image is shifted onto what is
// nearest to it.
PartAcross part_across(const Editor& editor, std::span<const float> positions, const Handle& handle,
                       const MirrorPlane& plane, double reach);

// What shows what stands so far off there: p → F p + shift, with F the reflection across the plane.
Reflection reflection(const MirrorPlane& plane, const Vec3d& shift);

} // namespace knead

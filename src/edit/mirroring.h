#pragma once
// The other side of a cloud: where the plane lies across which it is most like its own mirror image, and
// which points are a handle's there.

#include "base/types.h"
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

// A shape, as it lies in the order of computation.
struct ShapeInOrder {
    std::span<const float> positions; // 3n
    std::span<const Index> ordered;   // of each point of the file: its place there; no_index: it has none
};

// The points whose mirror image lies nearest to one of the points of a handle (`held`, of the file); nothing
// farther off than `reach` counts. Where that finds less than half as many as the handle has, as a leg that
// is set forward has nothing across it, the image is shifted onto what is nearest to it.
PartAcross part_across(const ShapeInOrder& shape, std::span<const Index> held, const MirrorPlane& plane,
                       double reach);

// The mirror across the plane, and then a shift: p → F p + shift, with F the reflection. It shows where the
// counterpart of a point lies that stands so far off its mirror image.
Reflection reflection(const MirrorPlane& plane, const Vec3d& shift);

} // namespace knead

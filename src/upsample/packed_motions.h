#pragma once
// Private to this room: the motions as the kernel and its reference read them.

#include "upsample/upsample.h"

namespace knead {

// A motion by columns, A00 A10 A20 0  A01 A11 A21 c0  A02 A12 A22 c1  d0 d1 d2 c2: one cache line. c = ½ p_s
// and d = b + A c, so that a point is displaced by A̅ (p - c̅) + d̅ with everything blended; c = 0 and d = b
// where the weights are the paper's.
struct alignas(64) PackedMotion {
    float column[4][4];
};

// One for each, of as many. `places`: of UpsampleInput.
void pack_motions(std::span<const Motion> motions, InfluenceWeights weights, std::span<const Vec3d> places,
                  std::span<PackedMotion> packed);

} // namespace knead

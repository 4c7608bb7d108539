#pragma once
// Private to this room: what the kernel and its reference share, the motions as they read them and the checks
// of what they are given.

#include "upsample/upsample.h"

namespace knead {

// A motion by columns, A00 A10 A20 1  A01 A11 A21 0  A02 A12 A22 0  b0 b1 b2 0: one cache line. A sum of
// weighted motions so has the sum of the weights in its fourth float.
struct alignas(64) PackedMotion {
    float column[4][4];
};

// One for each, of as many.
inline void pack_motions(std::span<const Motion> motions, std::span<PackedMotion> packed) {
    for (std::size_t m = 0; m < motions.size(); ++m)
        for (std::size_t column = 0; column < 4; ++column) {
            float* const to = packed[m].column[column];
            for (std::size_t row = 0; row < 3; ++row) to[row] = motions[m].map[4 * row + column];
            to[3] = column == 0 ? 1.0F : 0.0F;
        }
}

// Breaks off on sizes that do not fit each other, and on rows and samples that do not exist.
void require_valid_input(const UpsampleInput& input, std::size_t motions);
void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals);

} // namespace knead

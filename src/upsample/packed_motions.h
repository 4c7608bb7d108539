#pragma once
// Private to this room: what the kernel and its reference share, the motions as they read them and the checks
// of what they are given.

#include "upsample/upsample.h"

namespace knead {

// Sixteen floats a motion, by columns: A00 A10 A20 1  A01 A11 A21 0  A02 A12 A22 0  b0 b1 b2 0. One cache
// line. A sum of weighted motions so has the sum of the weights in its fourth float.
inline constexpr std::size_t packed_motion_floats = 16;

// `packed` has room for 16 floats a motion.
inline void pack_motions(std::span<const Motion> motions, float* packed) {
    for (const Motion& motion : motions) {
        for (std::size_t column = 0; column < 4; ++column) {
            for (std::size_t row = 0; row < 3; ++row) packed[row] = motion.map[4 * row + column];
            packed[3] = column == 0 ? 1.0F : 0.0F;
            packed += 4;
        }
    }
}

// Breaks off on sizes that do not fit each other, and on rows and samples that do not exist.
void require_valid_input(const UpsampleInput& input, std::size_t motions);
void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals);

} // namespace knead

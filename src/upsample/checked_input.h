#pragma once
// Private to this room: what an Upsampler is given is checked before it is used.

#include "upsample/upsample.h"

namespace knead {

// Breaks off on sizes that do not fit each other, and on rows and motions that do not exist.
void require_valid_input(const UpsampleInput& input, std::size_t motions, Workers& workers);
void require_motions(std::size_t motions_prepared, std::span<const Motion> motions);
void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals);

} // namespace knead

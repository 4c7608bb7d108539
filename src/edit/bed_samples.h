#pragma once
// Samples around what is small: the shape changes there within less than the samples' spacing.

#include "edit/small_patches.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// Free vertices around small patches that become samples beside the base samples, at most `most`. They lie
// the denser the nearer the patch is: .7 % of the cloud's size apart, and 15 % of the way to the patch and of
// its radius. Chosen one by one, each where it lacks most; so the first of them do most, and where the base
// samples, those that `near` tells of, are as dense already, there are none. All different. `hanging`: of
// each vertex, 1 for an outlier, or empty; `positions`: 3 floats a vertex.
std::vector<Index> bed_samples(std::span<const SmallPatch> patches, const Vicinities& near,
                               std::span<const std::uint8_t> hanging, std::span<const float> positions,
                               double cloud_size, std::size_t most);

} // namespace knead

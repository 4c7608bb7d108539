#pragma once
// Private to this room: breaks off on input that an Upsampler must not be given.

#include "upsample/upsample.h"

#include <vector>

namespace knead {

// Checks input on sizes that do not fit each other, and on rows and motions that do not exist. Remembers what
// the rows name, and reads of them only what changed since it did.
class CheckedInput {
public:
    void check(const UpsampleInput& input, std::size_t motions, Workers& workers);

private:
    std::vector<Index> past_largest_; // of each block of rows: one past the largest number in it
    std::uint64_t version_ = 0;       // of the rows that it is of
};

void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals);

} // namespace knead

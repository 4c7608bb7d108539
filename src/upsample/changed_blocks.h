#pragma once
// Private to this room: which blocks of points a frame has to write, and which it would only write again.
//
// A block that one and the same motion moves alone - a handle, what lies outside the region of interest,
// parts that are frozen - is as it was in the last frame if that motion is. All others are taken to change.

#include "upsample/packed_motions.h"

#include <vector>

namespace knead {

class ChangedBlocks {
public:
    // Takes who moves which points. No frame has been written yet.
    void prepare(const UpsampleInput& input, std::size_t motions, Workers& workers);

    // What a frame of these motions has to write into these spans, ascending, good until the next call. Until
    // note_written() the next frame has to write everything.
    std::span<const Index> of_frame(std::span<const PackedMotion> motions, std::span<const float> positions,
                                    std::span<const float> normals, Held held);
    void note_written() { last_is_whole_ = true; }

private:
    std::vector<Index> lone_mover_;      // of each block: a place in lone_motions_, or no_index
    std::vector<Index> lone_motions_;    // that move a block alone, each once
    std::vector<PackedMotion> before_;   // each of them in the last frame
    std::vector<std::uint8_t> is_other_; // whether it was another one then
    std::vector<Index> changed_;
    const float* positions_ = nullptr; // where the last frame was written
    const float* normals_ = nullptr;
    bool last_is_whole_ = false;
};

} // namespace knead

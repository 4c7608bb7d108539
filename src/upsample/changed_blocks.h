#pragma once
// Private to this room: which blocks of points a frame has to write, and which it would only write again.
//
// A block that one and the same motion moves alone - a handle, what lies outside the region of interest,
// parts that are frozen - is as it was in an earlier frame if that motion is, and was in all between. All
// others are taken to change.

#include "upsample/packed_motions.h"

#include <array>
#include <cstdint>
#include <vector>

namespace knead {

class ChangedBlocks {
public:
    // Takes who moves which points. No frame has been written yet.
    void prepare(const UpsampleInput& input, std::size_t motions, Workers& workers);

    // What a frame of these motions has to write into these spans, ascending, good until the next call. Until
    // note_written() all spans that were written before are taken to hold nothing.
    std::span<const Index> of_frame(std::span<const PackedMotion> motions, std::span<const float> positions,
                                    std::span<const float> normals, Held held);
    void note_written() { last_is_whole_ = true; }

private:
    // Where frames were written, and which of them, from 1; 0: none.
    struct Target {
        const float* positions = nullptr;
        const float* normals = nullptr;
        std::uint64_t frame = 0;
    };
    std::uint64_t begin_frame_in(Target target);

    std::vector<Index> lone_mover_;    // of each block: a place in lone_motions_, or no_index
    std::vector<Index> lone_motions_;  // that move a block alone, each once
    std::vector<PackedMotion> before_; // each of them in the last frame
    std::vector<std::uint64_t> since_; // the frame since which each is what it was then
    std::vector<Index> changed_;
    std::array<Target, most_targets> targets_; // the last one first
    std::uint64_t frame_ = 0;                  // the last one
    bool last_is_whole_ = false;
};

} // namespace knead

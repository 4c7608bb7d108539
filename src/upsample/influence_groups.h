#pragma once
// Private to this room: what moves which point, as a frame reads it.
//
// Points come in Morton order, so sixteen consecutive ones are neighbours and share most of the samples
// around them. A group of sixteen names each of those once, with its share in each of the points: a frame
// then reads a motion once a group and not once a point, works on sixteen points side by side, and knows no
// exceptions. A point that one motion alone moves, one right at a sample, one near a handle, and one with few
// samples around it are the same to it.
//
// A share is a weight in parts of 65,535, rounded so that those of a point sum to all of them. So one motion
// a group needs none: it has what the others leave. What moves a point alone has all, and nothing else any:
// a point that is held is held to the bit. (Rounding moves a point by 1/131,070 of how far apart the motions
// around it send it, at most for each; distances come in coarser levels, graph/flood.h.)

#include "base/large_pages.h"
#include "upsample/shares.h"
#include "upsample/upsample.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

inline constexpr std::size_t points_in_group = 16;

// `motion` has what entries `first` to `first` + `count` leave. Motions rise, its own first: handles are
// last.
struct InfluenceGroup {
    Index motion = 0; // 0 for one that moves nothing, else its number and 1
    Index first = 0, count = 0;
};

// Motions with this number or a higher one have no place (upsample.h): handles. With the paper's weights it
// does not matter.
inline Index first_without_place(const UpsampleInput& input) {
    const Index first = input.weights == InfluenceWeights::paper ? no_index : input.rows->first_handle;
    return first == no_index ? no_index : first + 1;
}

class InfluenceGroups {
public:
    // Takes who moves which points. Only blocks that `input.changed` names are made again where all else is
    // as before. Throws Error (input) where there are more entries than Index can count.
    void prepare(const UpsampleInput& input, Workers& workers);

    // One for every sixteen points; of the last one those points that there are.
    std::span<const InfluenceGroup> groups() const { return groups_; }
    // Of each entry: a motion, as a group has one.
    std::span<const Index> motion() const { return motion_; }
    // Of each entry: its shares in the sixteen points, 0 where it moves a point not at all.
    std::span<const std::uint16_t> share() const { return share_; }

    // What a frame of all points reads of this.
    std::size_t bytes() const;

private:
    struct Room { // of a block, in the entries
        Index first = 0, size = 0;
    };
    std::vector<Index> count_entries(std::span<const Index> blocks, const UpsampleInput& input,
                                     Workers& workers);
    void write_entries(std::span<const Index> blocks, const UpsampleInput& input, Workers& workers);
    void make_all(const UpsampleInput& input, Workers& workers);
    bool make_again(std::span<const Index> blocks, const UpsampleInput& input, Workers& workers);

    std::vector<InfluenceGroup> groups_;
    std::vector<Index> motion_;
    LineArray<std::uint16_t> share_;
    std::vector<Room> room_; // of each block
    std::size_t used_ = 0;   // entries; behind them is room for blocks that grow
    struct Made {            // of what
        const Index* mover = nullptr;
        std::size_t points = 0;
        const InfluenceRows* rows = nullptr;
        std::size_t row_count = 0;
        Index first_handle = 0;
        InfluenceWeights weights = InfluenceWeights::smooth;
        bool operator==(const Made&) const = default;
    } made_;
};

} // namespace knead

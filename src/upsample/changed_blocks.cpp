#include "upsample/changed_blocks.h"

#include "base/workers.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <array>
#include <bit>

namespace knead {

namespace {

constexpr std::size_t grain = 256; // blocks

bool same_bits(const PackedMotion& a, const PackedMotion& b) {
    using Bits = std::array<std::uint32_t, sizeof(PackedMotion) / sizeof(std::uint32_t)>;
    return std::bit_cast<Bits>(a) == std::bit_cast<Bits>(b);
}

// The motion that alone moves all these points; no_index where there is none.
Index lone_motion(std::span<const Index> movers, std::size_t rows) {
    const Index first = movers.front();
    if (first < rows || std::ranges::any_of(movers, [&](Index mover) { return mover != first; }))
        return no_index;
    return static_cast<Index>(first - rows);
}

} // namespace

void ChangedBlocks::prepare(const UpsampleInput& input, std::size_t motions, Workers& workers) {
    const std::size_t points = input.mover.size();
    lone_mover_.resize(blocks_of(points));
    workers.for_each(lone_mover_.size(), grain, [&](std::size_t block) {
        const PointRange own = points_of(block, points);
        lone_mover_[block] =
            lone_motion(input.mover.subspan(own.first, own.end - own.first), input.rows->size());
    });
    lone_motions_.clear();
    std::vector<Index> place(motions, no_index); // of a motion in lone_motions_
    for (Index& mover : lone_mover_) {
        if (mover == no_index) continue;
        const Index motion = mover;
        if (place[motion] == no_index) {
            place[motion] = static_cast<Index>(lone_motions_.size());
            lone_motions_.push_back(motion);
        }
        mover = place[motion];
    }
    before_.assign(lone_motions_.size(), {});
    since_.assign(lone_motions_.size(), 0);
    changed_.clear();
    changed_.reserve(lone_mover_.size());
    last_is_whole_ = false;
    frame_ = 0;
}

// Returns the frame that these spans hold, as far as is known.
std::uint64_t ChangedBlocks::begin_frame_in(Target target) {
    if (!last_is_whole_) targets_.fill({});
    last_is_whole_ = false;
    const auto same = std::ranges::find_if(targets_, [&](const Target& known) {
        return known.positions == target.positions && known.normals == target.normals;
    });
    const auto last = same == targets_.end() ? targets_.end() - 1 : same;
    const std::uint64_t holds = same == targets_.end() ? 0 : same->frame;
    std::move_backward(targets_.begin(), last, last + 1);
    targets_.front() = target;
    return holds;
}

std::span<const Index> ChangedBlocks::of_frame(std::span<const PackedMotion> motions,
                                               std::span<const float> positions,
                                               std::span<const float> normals, Held held) {
    const std::uint64_t known = begin_frame_in({positions.data(), normals.data(), ++frame_});
    const std::uint64_t holds = held == Held::last_frame ? known : 0;
    for (std::size_t m = 0; m < lone_motions_.size(); ++m) {
        const PackedMotion& now = motions[lone_motions_[m]];
        if (frame_ == 1 || !same_bits(before_[m], now)) since_[m] = frame_;
        before_[m] = now;
    }
    changed_.clear();
    for (std::size_t block = 0; block < lone_mover_.size(); ++block) {
        const Index lone = lone_mover_[block];
        if (lone == no_index || since_[lone] > holds) changed_.push_back(static_cast<Index>(block));
    }
    return changed_;
}

} // namespace knead

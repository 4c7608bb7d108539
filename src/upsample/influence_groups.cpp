#include "upsample/influence_groups.h"

#include "base/error.h"
#include "base/large_pages.h"
#include "base/workers.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <numeric>

namespace knead {

namespace {

static_assert(points_in_block % points_in_group == 0);
constexpr std::size_t grain = 16; // blocks

// Of every so many entries, room for one more is kept for blocks that grow.
constexpr std::size_t entries_for_one_spare = 32;

// A group that is being made: each motion once, in the order in which they are met.
struct MadeGroup {
    static constexpr std::size_t most = points_in_group * influences_per_row;
    std::array<Index, most> motion;
    std::array<std::array<std::uint16_t, points_in_group>, most> share;
    std::size_t count = 0;
    std::array<std::size_t, influences_per_row> guess{}; // where the point before had them

    void begin() {
        count = 0;
        guess.fill(0);
    }
    // Those that move one more point.
    void add(const Movers& movers) {
        for (std::size_t k = 0; k < movers.count; ++k) guess[k] = place_of(movers.motion[k], guess[k]);
    }
    void add(const Movers& movers, std::size_t point) {
        add(movers);
        const auto shares = shares_of(movers);
        for (std::size_t k = 0; k < movers.count; ++k) share[guess[k]][point] = shares[k];
    }
    std::size_t place_of(Index wanted, std::size_t likely) {
        if (likely < count && motion[likely] == wanted) return likely;
        for (std::size_t at = 0; at < count; ++at)
            if (motion[at] == wanted) return at;
        motion[count] = wanted;
        share[count].fill(0);
        return count++;
    }
    // Where they are, by rising number.
    std::span<const std::uint8_t> sorted(std::array<std::uint8_t, most>& places) const {
        const auto used = std::span(places).first(count);
        std::iota(used.begin(), used.end(), std::uint8_t{0});
        std::ranges::sort(used, {}, [&](std::uint8_t at) { return motion[at]; });
        return used;
    }
};

// What a group is made for: to know how many motions it has, or with their shares, too.
enum class Wanted { count, shares };

template<Wanted wanted, typename Rows>
void make_group(const UpsampleInput& input, const Rows& rows, std::size_t first, std::size_t end,
                MadeGroup& made) {
    const bool balanced = wanted == Wanted::shares && input.weights == InfluenceWeights::smooth;
    const auto movers_at = [&](std::size_t i) {
        const Index mover = input.mover[i];
        if (mover >= rows.size()) return moved_alone(static_cast<Index>(mover - rows.size()) + 1);
        SampleOffsets offsets;
        if (balanced) offsets = offsets_from(point_at(input.positions, i), rows[mover], input.places);
        return movers_of(rows[mover], input.rows->first_handle, input.weights, balanced ? &offsets : nullptr);
    };
    made.begin();
    for (std::size_t i = first; i < end; ++i)
        if constexpr (wanted == Wanted::count)
            made.add(movers_at(i));
        else
            made.add(movers_at(i), i - first);
}

// Calls take(group, made) for each group of a block.
template<Wanted wanted, typename Take>
void for_groups(const UpsampleInput& input, std::size_t block, MadeGroup& made, Take&& take) {
    const PointRange own = points_of(block, input.mover.size());
    std::visit(
        [&](const auto& rows) {
            for (std::size_t first = own.first; first < own.end; first += points_in_group) {
                make_group<wanted>(input, rows, first, std::min(first + points_in_group, own.end), made);
                take(first / points_in_group, made);
            }
        },
        input.rows->rows);
}

} // namespace

void InfluenceGroups::prepare(const UpsampleInput& input, Workers& workers) {
    const std::size_t blocks = blocks_of(input.mover.size());
    const Made made{input.mover.data(), input.mover.size(),       input.rows,
                    input.rows->size(), input.rows->first_handle, input.weights};
    const bool goes_on = made == made_ && input.changed.size() == blocks;
    made_ = {};
    std::vector<Index> changed;
    for (std::size_t b = 0; goes_on && b < blocks; ++b)
        if (input.changed[b]) changed.push_back(static_cast<Index>(b));
    if (!goes_on || changed.size() > blocks / 2 || !make_again(changed, input, workers))
        make_all(input, workers);
    made_ = made;
}

std::size_t InfluenceGroups::bytes() const {
    std::size_t entries = 0;
    for (const InfluenceGroup& group : groups_) entries += group.count;
    return groups_.size() * sizeof(InfluenceGroup) +
           entries * (sizeof(Index) + points_in_group * sizeof(std::uint16_t));
}

// The entries of each group of these blocks, and of each of the blocks.
std::vector<Index> InfluenceGroups::count_entries(std::span<const Index> blocks, const UpsampleInput& input,
                                                  Workers& workers) {
    std::vector<Index> counts(blocks.size());
    workers.for_chunks(blocks.size(), grain, [&](std::size_t begin, std::size_t end) {
        MadeGroup made;
        for (std::size_t b = begin; b < end; ++b)
            for_groups<Wanted::count>(input, blocks[b], made, [&](std::size_t group, const MadeGroup& one) {
                groups_[group].count = static_cast<Index>(one.count - 1);
                counts[b] += groups_[group].count;
            });
    });
    return counts;
}

// Into the room of each of these blocks.
void InfluenceGroups::write_entries(std::span<const Index> blocks, const UpsampleInput& input,
                                    Workers& workers) {
    workers.for_chunks(blocks.size(), grain, [&](std::size_t begin, std::size_t end) {
        MadeGroup made;
        std::array<std::uint8_t, MadeGroup::most> places;
        for (std::size_t b = begin; b < end; ++b) {
            std::size_t at = room_[blocks[b]].first;
            for_groups<Wanted::shares>(input, blocks[b], made, [&](std::size_t group, const MadeGroup& one) {
                const auto entries = one.sorted(places);
                groups_[group].motion = one.motion[entries[0]];
                groups_[group].first = static_cast<Index>(at);
                for (const std::uint8_t entry : entries.subspan(1)) {
                    motion_[at] = one.motion[entry];
                    std::memcpy(share_.data() + points_in_group * at, one.share[entry].data(),
                                sizeof one.share[entry]);
                    ++at;
                }
            });
        }
    });
}

// One pass counts, and one writes: entries are many, and in two places at once they would take twice as much.
void InfluenceGroups::make_all(const UpsampleInput& input, Workers& workers) {
    const std::size_t blocks = blocks_of(input.mover.size());
    groups_.resize((input.mover.size() + points_in_group - 1) / points_in_group);
    motion_ = std::vector<Index>(); // {} would keep the memory
    share_ = LineArray<std::uint16_t>();
    std::vector<Index> all(blocks);
    std::iota(all.begin(), all.end(), Index{0});
    const std::vector<Index> counts = count_entries(all, input, workers);
    room_.resize(blocks);
    used_ = 0;
    for (std::size_t b = 0; b < blocks; ++b) {
        room_[b] = {static_cast<Index>(used_), counts[b]};
        used_ += counts[b];
    }
    const std::size_t size = used_ + used_ / entries_for_one_spare;
    if (size > no_index)
        throw Error(Trouble::input, "", "these are more points than can be moved; take fewer of them");
    resize_in_large_pages(motion_, size, workers);
    resize_in_large_pages(share_, points_in_group * size, workers);
    write_entries(all, input, workers);
}

// False if there is no room for them left.
bool InfluenceGroups::make_again(std::span<const Index> blocks, const UpsampleInput& input,
                                 Workers& workers) {
    const std::vector<Index> counts = count_entries(blocks, input, workers);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        Room& room = room_[blocks[b]];
        if (counts[b] <= room.size) continue;
        if (used_ + counts[b] > motion_.size()) return false;
        room = {static_cast<Index>(used_), counts[b]};
        used_ += counts[b];
    }
    write_entries(blocks, input, workers);
    return true;
}

} // namespace knead

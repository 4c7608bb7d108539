#include "upsample/influence_groups.h"

#include "base/error.h"
#include "base/large_pages.h"
#include "base/workers.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numeric>

namespace knead {

namespace {

static_assert(points_in_block % points_in_group == 0);
constexpr std::size_t grain = 16; // blocks
constexpr float largest_root = 65535;

// Of every so many entries, room for one more is kept for blocks that grow.
constexpr std::size_t entries_for_one_spare = 32;

// What moves one point: entries' numbers and roots.
struct Lane {
    std::array<Index, influences_per_row> number;
    std::array<std::uint16_t, influences_per_row> root;
    std::size_t count = 0;

    void add(Index one, std::uint16_t its_root) {
        number[count] = one;
        root[count] = its_root;
        count += its_root != 0 ? 1 : 0; // what does not count is written over
    }
};

Index entry_of(Index motion) {
    return motion + 1;
}
constexpr Index nobody = 0;

Lane moved_alone(Index number) {
    Lane lane;
    lane.add(number, 1);
    return lane;
}

// Roots of any weights: as they are where all are whole numbers, else as parts of the largest.
template<typename Number>
Lane moved_by_weights(const SampleRow<Number>& row, Index first_handle, InfluenceWeights weights) {
    const std::size_t count = row.count();
    if (count == 0) return moved_alone(nobody);
    auto root = weights_of(row, first_handle, weights);
    float largest = 0;
    bool are_whole = true;
    for (float& one : root) {
        one = std::sqrt(one);
        largest = std::max(largest, one);
        are_whole = are_whole && one == std::floor(one);
    }
    const float scale = are_whole && largest <= largest_root ? 1.0F : largest_root / largest;
    Lane lane;
    for (std::size_t k = 0; k < count; ++k)
        lane.add(entry_of(row.sample[k]),
                 static_cast<std::uint16_t>(std::min(std::round(root[k] * scale), largest_root)));
    return lane;
}

// The same; nearly all rows of smooth weights are full and name no handle.
template<typename Number>
Lane moved_by(const SampleRow<Number>& row, Index first_handle, InfluenceWeights weights) {
    const Number nearest = row.distance.front(), farthest = row.distance.back();
    Number last = 0;
    for (const Number sample : row.sample) last = std::max(last, sample);
    if (weights != InfluenceWeights::smooth || last >= first_handle || row.sample.back() == row.none ||
        nearest == farthest || farthest - nearest > static_cast<Number>(largest_root))
        return moved_by_weights(row, first_handle, weights);
    Lane lane;
    for (std::size_t k = 0; k < influences_per_row; ++k)
        lane.add(entry_of(row.sample[k]), static_cast<std::uint16_t>(farthest - row.distance[k]));
    return lane;
}

// A group that is being made: each motion once, in the order in which they are met.
struct MadeGroup {
    static constexpr std::size_t most = points_in_group * influences_per_row;
    std::array<Index, most> number;
    std::array<std::array<std::uint16_t, points_in_group>, most> root;
    std::size_t count = 0;
    std::array<std::size_t, influences_per_row> guess{}; // where the point before had them

    void begin() {
        count = 0;
        guess.fill(0);
    }
    void add(const Lane& lane, std::size_t point) {
        for (std::size_t k = 0; k < lane.count; ++k) {
            const std::size_t at = place_of(lane.number[k], guess[k]);
            guess[k] = at;
            root[at][point] = lane.root[k];
        }
    }
    std::size_t place_of(Index wanted, std::size_t likely) {
        if (likely < count && number[likely] == wanted) return likely;
        for (std::size_t at = 0; at < count; ++at)
            if (number[at] == wanted) return at;
        number[count] = wanted;
        root[count].fill(0);
        return count++;
    }
};

template<typename Rows>
void make_group(const UpsampleInput& input, const Rows& rows, std::size_t first, std::size_t end,
                MadeGroup& made) {
    made.begin();
    for (std::size_t i = first; i < end; ++i) {
        const Index mover = input.mover[i];
        made.add(mover < rows.size() ? moved_by(rows[mover], input.rows->first_handle, input.weights)
                                     : moved_alone(entry_of(static_cast<Index>(mover - rows.size()))),
                 i - first);
    }
}

// Calls take(group, made) for each group of a block.
template<typename Take>
void for_groups(const UpsampleInput& input, std::size_t block, MadeGroup& made, Take&& take) {
    const PointRange own = points_of(block, input.mover.size());
    std::visit(
        [&](const auto& rows) {
            for (std::size_t first = own.first; first < own.end; first += points_in_group) {
                make_group(input, rows, first, std::min(first + points_in_group, own.end), made);
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
            for_groups(input, blocks[b], made, [&](std::size_t group, const MadeGroup& one) {
                groups_[group].count = static_cast<Index>(one.count);
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
        for (std::size_t b = begin; b < end; ++b) {
            std::size_t at = room_[blocks[b]].first;
            for_groups(input, blocks[b], made, [&](std::size_t group, const MadeGroup& one) {
                groups_[group].first = static_cast<Index>(at);
                std::copy_n(one.number.begin(), one.count, number_.data() + at);
                std::memcpy(root_.data() + points_in_group * at, one.root.data(),
                            one.count * sizeof one.root[0]);
                at += one.count;
            });
        }
    });
}

// One pass counts, and one writes: entries are many, and in two places at once they would take twice as much.
void InfluenceGroups::make_all(const UpsampleInput& input, Workers& workers) {
    const std::size_t blocks = blocks_of(input.mover.size());
    groups_.resize((input.mover.size() + points_in_group - 1) / points_in_group);
    number_ = {};
    root_ = {};
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
        throw Error(Trouble::numeric, "", "these are more points than can be moved; take fewer of them");
    resize_in_large_pages(number_, size);
    resize_in_large_pages(root_, points_in_group * size);
    write_entries(all, input, workers);
}

// False if there is no room for them left.
bool InfluenceGroups::make_again(std::span<const Index> blocks, const UpsampleInput& input,
                                 Workers& workers) {
    const std::vector<Index> counts = count_entries(blocks, input, workers);
    for (std::size_t b = 0; b < blocks.size(); ++b) {
        Room& room = room_[blocks[b]];
        if (counts[b] <= room.size) continue;
        if (used_ + counts[b] > number_.size()) return false;
        room = {static_cast<Index>(used_), counts[b]};
        used_ += counts[b];
    }
    write_entries(blocks, input, workers);
    return true;
}

} // namespace knead

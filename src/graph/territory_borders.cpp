#include "graph/territory_borders.h"

#include "base/gathered.h"
#include "base/paged.h"
#include "base/require.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t grain = 1 << 14;
constexpr std::size_t blocks_at_once = 16;

// How many links more, or fewer, than somewhere before cross the border of two territories.
struct Change {
    std::uint64_t border = 0; // the lower sample above the higher one
    std::int64_t links = 0;
    Index way = no_index; // the shortest by one of those that are more
};

// Counts links where the same few borders are met again and again: a hash table, open, at most half full.
class Tally {
public:
    // Nothing within one territory. Links between vertices that no sample reaches are within one, too.
    void add(Index one, Index other, std::int64_t links, Index way = no_index) {
        if (one == other) return;
        const std::uint64_t border = std::uint64_t{std::min(one, other)} << 32 | std::max(one, other);
        Change& place = changes_[place_of(border)];
        if (place.border == none) {
            place.border = border;
            ++used_;
        }
        place.links += links;
        place.way = std::min(place.way, way);
        if (2 * used_ > changes_.size()) grow();
    }

    template<typename Visit>
    void each(Visit&& visit) const {
        for (const Change& change : changes_)
            if (change.border != none && (change.links != 0 || change.way != no_index)) visit(change);
    }

private:
    static constexpr std::uint64_t none = ~std::uint64_t{0};

    std::size_t place_of(std::uint64_t border) const {
        const std::size_t mask = changes_.size() - 1;
        std::size_t place = (border * 0x9e3779b97f4a7c15ULL) >> shift_; // Fibonacci hashing
        while (changes_[place].border != none && changes_[place].border != border) place = (place + 1) & mask;
        return place;
    }

    void grow() {
        const std::vector<Change> old =
            std::exchange(changes_, std::vector<Change>(2 * changes_.size(), empty));
        --shift_;
        for (const Change& change : old)
            if (change.border != none) changes_[place_of(change.border)] = change;
    }

    static constexpr Change empty{none, 0, no_index};
    static constexpr std::size_t at_first = 256;
    std::vector<Change> changes_ = std::vector<Change>(at_first, empty);
    int shift_ = 64 - std::countr_zero(at_first);
    std::size_t used_ = 0;
};

using Changes = Gathered<Change>;

void hand_over(const Tally& tally, Changes::Block& changes) {
    tally.each([&](const Change& change) { changes.push(change); });
}

// What the changes, ascending, come to.
std::vector<TerritoryBorder> summed(std::span<const Change> changes) {
    std::vector<TerritoryBorder> borders;
    for (auto change = changes.begin(); change != changes.end();) {
        const std::uint64_t border = change->border;
        std::int64_t links = 0;
        Index way = no_index;
        for (; change != changes.end() && change->border == border; ++change) {
            links += change->links;
            way = std::min(way, change->way);
        }
        if (links != 0)
            borders.push_back({static_cast<Index>(border >> 32), static_cast<Index>(border),
                               static_cast<Index>(links), way});
    }
    return borders;
}

std::vector<TerritoryBorder> summed(std::span<const TerritoryBorder> before, Changes& found) {
    std::vector<Change> all;
    all.reserve(before.size() + found.size());
    for (const auto& [a, b, links, way] : before) all.push_back({std::uint64_t{a} << 32 | b, links, way});
    const auto middle = static_cast<std::ptrdiff_t>(all.size()); // up to which they ascend
    found.take([&](const Change& change) { all.push_back(change); });
    const auto by_border = [](const Change& one, const Change& other) { return one.border < other.border; };
    std::sort(all.begin() + middle, all.end(), by_border);
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(), by_border);
    return summed(all);
}

template<typename Row>
void find_all(const std::vector<Row>& nearest, const Graph& points, Workers& workers, Changes& found) {
    workers.for_chunks(points.size(), grain, [&](std::size_t begin, std::size_t end) {
        Changes::Block changes(found);
        Tally tally;
        for (std::size_t p = begin; p < end; ++p)
            for (const Index q : points.row(p)) {
                if (q > p) break; // rows ascend, and the link is met again from its other end
                tally.add(nearest[p].sample[0], nearest[q].sample[0], 1);
            }
        hand_over(tally, changes);
    });
}

// No sample has this number: there are no more of them than vertices (2^32 - 2).
constexpr Index unchanged = no_index - 1;

// Of each vertex the sample that was the nearest, where it is another one now.
template<typename Row>
Paged<Index> former_nearest(const std::vector<Row>& nearest, const OldRows<Row>& blocks, Workers& workers) {
    Paged<Index> former(nearest.size(), unchanged);
    for (const auto& block : blocks)
        block.each([&](const OldRow<Row>& old) { former.make_room(old.vertex); });
    workers.for_each(blocks.size(), blocks_at_once, [&](std::size_t block) {
        blocks[block].each([&](const OldRow<Row>& old) {
            if (old.sample[0] != nearest[old.vertex].sample[0]) former.set(old.vertex, old.sample[0]);
        });
    });
    return former;
}

template<typename Row>
void find_changed(const std::vector<Row>& nearest, const OldRows<Row>& blocks, const Graph& points,
                  std::span<const std::uint8_t> lengths, Workers& workers, Changes& found) {
    const Paged<Index> former = former_nearest(nearest, blocks, workers);
    workers.for_chunks(blocks.size(), blocks_at_once, [&](std::size_t begin, std::size_t end) {
        Changes::Block changes(found);
        Tally tally;
        const auto count_of = [&](const OldRow<Row>& old) {
            const Index p = old.vertex;
            if (former[p] == unchanged) return;
            for (Index link = points.first[p]; link < points.first[p + 1]; ++link) {
                const Index q = points.neighbor[link];
                const bool both_changed = former[q] != unchanged;
                if (both_changed && q > p) continue; // the link is met again from its other end
                const Index there = nearest[q].sample[0];
                const Index way = Index{nearest[p].distance[0]} + lengths[link] + nearest[q].distance[0];
                tally.add(former[p], both_changed ? former[q] : there, -1);
                tally.add(nearest[p].sample[0], there, 1, way);
            }
        };
        for (std::size_t block = begin; block < end; ++block) blocks[block].each(count_of);
        hand_over(tally, changes);
    });
}

} // namespace

std::vector<TerritoryBorder> territory_borders(const TerritoryRows& nearest, const Graph& points,
                                               Workers& workers) {
    Changes found;
    std::visit([&](const auto& rows) { find_all(rows, points, workers, found); }, nearest.rows);
    return summed({}, found);
}

std::vector<TerritoryBorder> territory_borders_after(std::span<const TerritoryBorder> before,
                                                     const TerritoryPatch& patch,
                                                     const TerritoryRows& nearest, const Graph& points,
                                                     std::span<const std::uint8_t> lengths,
                                                     Workers& workers) {
    require(lengths.size() == points.neighbor.size(), "a length a link");
    Changes found;
    std::visit(
        [&]<typename Row>(const std::vector<Row>& rows) {
            find_changed(rows, std::get<OldRows<Row>>(patch.blocks), points, lengths, workers, found);
        },
        nearest.rows);
    return summed(before, found);
}

} // namespace knead

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
    Index way = no_index;  // the shortest by one of those that are more
    Index lost = no_index; // and by one of those that are fewer
};

// Counts links where the same few borders are met again and again: a hash table, open, at most half full.
class Tally {
public:
    // A link that there is, or is no longer, with the way from sample to sample by it. Nothing within one
    // territory. Links between vertices that no sample reaches are within one, too.
    void add(Index one, Index other, Index way = no_index) {
        if (one == other) return;
        Change& change = change_of(one, other);
        ++change.links;
        change.way = std::min(change.way, way);
    }
    void take_away(Index one, Index other, Index way) {
        if (one == other) return;
        Change& change = change_of(one, other);
        --change.links;
        change.lost = std::min(change.lost, way);
    }

    template<typename Visit>
    void each(Visit&& visit) const {
        for (const Change& change : changes_)
            if (change.border != none) visit(change);
    }

private:
    static constexpr std::uint64_t none = ~std::uint64_t{0};

    Change& change_of(Index one, Index other) {
        const std::uint64_t border = std::uint64_t{std::min(one, other)} << 32 | std::max(one, other);
        std::size_t place = place_of(border);
        if (changes_[place].border == none) {
            if (2 * ++used_ > changes_.size()) {
                grow();
                place = place_of(border);
            }
            changes_[place].border = border;
        }
        return changes_[place];
    }

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

    static constexpr Change empty{none, 0, no_index, no_index};
    static constexpr std::size_t at_first = 256;
    std::vector<Change> changes_ = std::vector<Change>(at_first, empty);
    int shift_ = 64 - std::countr_zero(at_first);
    std::size_t used_ = 0;
};

using Changes = Gathered<Change>;

void hand_over(const Tally& tally, Changes::Block& changes) {
    tally.each([&](const Change& change) { changes.push(change); });
}

struct Summed {
    std::vector<TerritoryBorder> borders;
    std::vector<std::size_t> unsure; // places of those whose way may have led by a link that is gone
};

// What the borders and changes, ascending, come to.
Summed summed_up(std::span<const Change> changes) {
    Summed result;
    for (auto change = changes.begin(); change != changes.end();) {
        Change sum{change->border};
        for (; change != changes.end() && change->border == sum.border; ++change) {
            sum.links += change->links;
            sum.way = std::min(sum.way, change->way);
            sum.lost = std::min(sum.lost, change->lost);
        }
        if (sum.links == 0) continue;
        if (sum.lost != no_index && sum.lost <= sum.way) result.unsure.push_back(result.borders.size());
        result.borders.push_back({static_cast<Index>(sum.border >> 32), static_cast<Index>(sum.border),
                                  static_cast<Index>(sum.links), sum.way});
    }
    return result;
}

Summed summed(std::span<const TerritoryBorder> before, Changes& found) {
    std::vector<Change> all;
    all.reserve(before.size() + found.size());
    for (const auto& [a, b, links, way] : before) all.push_back({std::uint64_t{a} << 32 | b, links, way});
    const auto middle = static_cast<std::ptrdiff_t>(all.size()); // up to which they ascend
    found.take([&](const Change& change) { all.push_back(change); });
    const auto by_border = [](const Change& one, const Change& other) { return one.border < other.border; };
    std::sort(all.begin() + middle, all.end(), by_border);
    std::inplace_merge(all.begin(), all.begin() + middle, all.end(), by_border);
    return summed_up(all);
}

template<typename Row>
void find_all(const std::vector<Row>& nearest, const Graph& points, Workers& workers, Changes& found) {
    workers.for_chunks(points.size(), grain, [&](std::size_t begin, std::size_t end) {
        Changes::Block changes(found);
        Tally tally;
        for (std::size_t p = begin; p < end; ++p)
            for (const Index q : points.row(p)) {
                if (q > p) break; // rows ascend, and the link is met again from its other end
                tally.add(nearest[p].sample[0], nearest[q].sample[0]);
            }
        hand_over(tally, changes);
    });
}

// The nearest sample of a vertex.
struct Nearest {
    Index sample, distance;
    bool operator==(const Nearest&) const = default;
};
template<typename Row>
Nearest nearest_of(const Row& row) {
    return {row.sample[0], row.distance[0]};
}

// What was the nearest of vertices that something else is the nearest of now.
class Former {
public:
    template<typename Row>
    Former(const std::vector<Row>& nearest, const OldRows<Row>& blocks, Workers& workers)
        : places_(nearest.size(), unchanged) {
        for (const auto& block : blocks)
            block.each([&](const OldRow<Row>& old) { places_.make_room(old.vertex); });
        workers.for_each(blocks.size(), blocks_at_once, [&](std::size_t block) {
            blocks[block].each([&](const OldRow<Row>& old) {
                if (const Nearest was = nearest_of(old); was != nearest_of(nearest[old.vertex]))
                    places_.set(old.vertex, std::uint64_t{was.sample} << 32 | was.distance);
            });
        });
    }

    bool is_another(Index vertex) const { return places_[vertex] != unchanged; }
    Nearest operator[](Index vertex) const { // if it is another
        const std::uint64_t place = places_[vertex];
        return {static_cast<Index>(place >> 32), static_cast<Index>(place)};
    }

private:
    // No sample has this number: there are no more of them than vertices (2^32 - 2).
    static constexpr std::uint64_t unchanged = std::uint64_t{no_index - 1} << 32;
    Paged<std::uint64_t> places_;
};

template<typename Row>
void find_changed(const std::vector<Row>& nearest, const OldRows<Row>& blocks, Index first_added,
                  const Graph& points, std::span<const std::uint8_t> lengths, Workers& workers,
                  Changes& found) {
    const Former former(nearest, blocks, workers);
    const auto way = [&](const Nearest& here, Index length, const Nearest& there) {
        const bool told = std::max(here.sample, there.sample) >= first_added;
        return told ? here.distance + length + there.distance : no_index;
    };
    workers.for_chunks(blocks.size(), blocks_at_once, [&](std::size_t begin, std::size_t end) {
        Changes::Block changes(found);
        Tally tally;
        const auto count_of = [&](const OldRow<Row>& old) {
            const Index p = old.vertex;
            if (!former.is_another(p)) return;
            const Nearest was = former[p], is = nearest_of(nearest[p]);
            for (Index link = points.first[p]; link < points.first[p + 1]; ++link) {
                const Index q = points.neighbor[link];
                const bool both_changed = former.is_another(q);
                if (both_changed && q > p) continue; // the link is met again from its other end
                const Nearest there = nearest_of(nearest[q]);
                const Nearest was_there = both_changed ? former[q] : there;
                tally.take_away(was.sample, was_there.sample, way(was, lengths[link], was_there));
                tally.add(is.sample, there.sample, way(is, lengths[link], there));
            }
        };
        for (std::size_t block = begin; block < end; ++block) blocks[block].each(count_of);
        hand_over(tally, changes);
    });
}

// Goes through the territory of an added sample, and finds how long the ways to these others are, of which
// each is told as a border that has no way yet.
template<typename Row>
void find_ways(std::span<TerritoryBorder*> borders, Index start, const std::vector<Row>& nearest,
               const Graph& points, std::span<const std::uint8_t> lengths, std::vector<bool>& is_met) {
    const Index own = nearest[start].sample[0];
    std::vector<Index> waiting{start};
    is_met[start] = true;
    while (!waiting.empty()) {
        const Index p = waiting.back();
        waiting.pop_back();
        for (Index link = points.first[p]; link < points.first[p + 1]; ++link) {
            const Index q = points.neighbor[link];
            const Nearest there = nearest_of(nearest[q]);
            if (there.sample == own) {
                if (!is_met[q]) waiting.push_back(q);
                is_met[q] = true;
                continue;
            }
            const auto border = std::ranges::find(borders, there.sample, &TerritoryBorder::a);
            if (border != borders.end())
                (*border)->way =
                    std::min((*border)->way, nearest[p].distance[0] + lengths[link] + there.distance);
        }
    }
}

// A territory hangs together: where the shortest way to a vertex runs, all is nearest to the same sample.
void find_ways_again(Summed& sum, const AddedStarts<1>& added, const TerritoryRows& nearest,
                     const Graph& points, std::span<const std::uint8_t> lengths) {
    if (sum.unsure.empty()) return;
    std::vector<TerritoryBorder*> unsure;
    for (const std::size_t place : sum.unsure) unsure.push_back(&sum.borders[place]);
    std::ranges::stable_sort(unsure, {}, &TerritoryBorder::b);
    std::vector<bool> is_met(points.size(), false);
    for (std::span<TerritoryBorder*> rest(unsure); !rest.empty();) {
        const Index b = rest.front()->b;
        const auto of_b = std::ranges::find_if(rest, [&](const TerritoryBorder* one) { return one->b != b; });
        const auto count = static_cast<std::size_t>(of_b - rest.begin());
        for (TerritoryBorder* border : rest.first(count)) border->way = no_index;
        const auto start = std::ranges::lower_bound(added.starts, b, {}, &FloodStart::number);
        require(start != added.starts.end() && start->number == b, "who has a way was added");
        std::visit(
            [&](const auto& rows) {
                find_ways(rest.first(count), start->vertex, rows, points, lengths, is_met);
            },
            nearest.rows);
        rest = rest.subspan(count);
    }
}

} // namespace

std::vector<TerritoryBorder> territory_borders(const TerritoryRows& nearest, const Graph& points,
                                               Workers& workers) {
    Changes found;
    std::visit([&](const auto& rows) { find_all(rows, points, workers, found); }, nearest.rows);
    return summed({}, found).borders;
}

std::vector<TerritoryBorder>
territory_borders_after(std::span<const TerritoryBorder> before, const TerritoryPatch& former,
                        const AddedStarts<1>& added, const TerritoryRows& nearest, const Graph& points,
                        std::span<const std::uint8_t> lengths, Workers& workers) {
    require(lengths.size() == points.neighbor.size(), "a length a link");
    Changes found;
    std::visit(
        [&]<typename Row>(const std::vector<Row>& rows) {
            find_changed(rows, std::get<OldRows<Row>>(former.blocks), added.first_number, points, lengths,
                         workers, found);
        },
        nearest.rows);
    Summed sum = summed(before, found);
    find_ways_again(sum, added, nearest, points, lengths);
    return std::move(sum.borders);
}

} // namespace knead

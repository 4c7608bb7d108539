#include "graph/starts_flood.h"

#include "base/gathered.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <bitset>
#include <cstdint>
#include <iterator>
#include <tuple>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t blocks_at_once = 16;

using Starts = std::vector<FloodStart>;

constexpr auto by_number = [](const FloodStart& a, const FloodStart& b) {
    return std::pair(a.number, a.vertex) < std::pair(b.number, b.vertex);
};

// Of each number from the first on, whether it goes: some start of it is no longer there. May end early.
using Gone = std::vector<std::uint8_t>;
template<std::size_t places>
Gone gone_numbers(const AddedStarts<places>& added, const Starts& starts) {
    Gone gone;
    for (const FloodStart& one : added.starts) {
        if (std::ranges::binary_search(starts, one, by_number)) continue;
        gone.resize(std::max(gone.size(), std::size_t{one.number - added.first_number} + 1), 0);
        gone[one.number - added.first_number] = 1;
    }
    return gone;
}

bool is_in(const Gone& gone, std::size_t beyond_first) {
    return beyond_first < gone.size() && gone[beyond_first] != 0;
}

// What starts flood along.
struct Surface {
    const Graph& graph;
    std::span<const std::uint8_t> lengths;
};

// Changes the rows of one kind.
template<typename Row>
class StartChange {
public:
    using Number = typename decltype(Row::sample)::value_type;
    static constexpr std::size_t places = std::tuple_size_v<decltype(Row::sample)>;

    StartChange(std::vector<Row>& rows, OldRows<Row>& without, Index first_number, const Gone& gone)
        : rows_(rows), without_(without), first_(first_number), gone_(gone) {}

    // Takes out of the rows of a block what is gone; `opened` receives those that held any of it as they
    // were.
    void take_out(std::size_t block, Pile<OldRow<Row>>& opened) const {
        auto& kept = without_[block];
        const auto is_left_alone = [&](const OldRow<Row>& old) {
            Row& row = rows_[old.vertex];
            if (std::ranges::none_of(row.sample, [&](Number s) { return is_gone(s); })) return false;
            opened.push({old.vertex, row.sample, row.distance});
            return !replace(row, Row{old.sample, old.distance});
        };
        kept.erase_if(is_left_alone);
    }

    // What neighbours hold of other starts and an opened row has room for.
    template<typename Add>
    void reach_again(Index vertex, const Surface& along, Add&& add) const {
        const Row& row = rows_[vertex];
        for (Index link = along.graph.first[vertex]; link < along.graph.first[vertex + 1]; ++link) {
            const Row& there = rows_[along.graph.neighbor[link]];
            if (!holds_added(there)) continue;
            for (std::size_t k = 0; k < there.count(); ++k) {
                if (there.sample[k] < first_) continue;
                const std::uint64_t distance = std::uint64_t{there.distance[k]} + along.lengths[link];
                if (is_better(row, there.sample[k], distance))
                    add(FloodStart{vertex, there.sample[k], static_cast<Index>(distance)});
            }
        }
    }

private:
    bool is_added(Number number) const { return number >= first_ && number != Row::none; }
    bool is_gone(Number number) const { return number >= first_ && is_in(gone_, number - first_); }
    bool holds_added(const Row& row) const { // decides nothing on the way
        bool found = false;
        for (const Number number : row.sample) found |= (number >= first_) & (number != Row::none);
        return found;
    }

    // Makes the row the K first of `base` and of the starts in it that stay; returns whether there are any.
    bool replace(Row& row, const Row& base) const {
        using Places = std::array<std::pair<Number, Number>, places>; // (distance, number), ascending
        Places staying, of_base;
        std::size_t count = 0;
        for (std::size_t k = 0; k < places; ++k) {
            if (is_added(row.sample[k]) && !is_gone(row.sample[k]))
                staying[count++] = {row.distance[k], row.sample[k]};
            of_base[k] = {base.distance[k], base.sample[k]}; // empty ones are last
        }
        for (std::size_t k = 0, s = 0; k < places; ++k) {
            const bool stays = s < count && staying[s] < of_base[k - s];
            std::tie(row.distance[k], row.sample[k]) = stays ? staying[s] : of_base[k - s];
            s += stays ? 1 : 0;
        }
        return count > 0;
    }

    static bool is_better(const Row& row, Number number, std::uint64_t distance) {
        if (std::pair(distance, std::uint64_t{number}) >=
            std::pair(std::uint64_t{row.distance.back()}, std::uint64_t{row.sample.back()}))
            return false;
        for (std::size_t k = 0; k < row.sample.size(); ++k)
            if (row.sample[k] == number) return row.distance[k] > distance;
        return true;
    }

    std::vector<Row>& rows_;
    OldRows<Row>& without_;
    Index first_;
    const Gone& gone_;
};

// Takes what is gone out of the rows, and adds to `starts` where the others come from to fill them again.
// Returns the rows that held any of it as they were.
template<typename Row>
OldRows<Row> take_out(const StartChange<Row>& change, std::span<std::vector<Index>> numbers,
                      Index first_number, const Gone& gone, const Surface& along, Workers& workers,
                      Starts& starts) {
    OldRows<Row> opened(numbers.size());
    workers.for_each(numbers.size(), blocks_at_once, [&](std::size_t block) {
        const auto is_gone = [&](Index number) { return is_in(gone, number - first_number); };
        if (std::erase_if(numbers[block], is_gone) > 0) change.take_out(block, opened[block]);
    });
    Gathered<FloodStart> found;
    workers.for_chunks(numbers.size(), blocks_at_once, [&](std::size_t begin, std::size_t end) {
        Gathered<FloodStart>::Block here(found);
        const auto fill = [&](const OldRow<Row>& old) {
            change.reach_again(old.vertex, along, [&](const FloodStart& one) { here.push(one); });
        };
        for (std::size_t block = begin; block < end; ++block) opened[block].each(fill);
    });
    found.take([&](const FloodStart& one) { starts.push_back(one); });
    return opened;
}

// Adds to `opened` the rows of a patch that are not among them.
template<typename Row>
void put_beside(const OldRows<Row>& patch, OldRows<Row>& opened, Workers& workers) {
    workers.for_each(patch.size(), blocks_at_once, [&](std::size_t block) {
        std::bitset<rows_in_block> is_there;
        opened[block].each([&](const OldRow<Row>& old) { is_there.set(old.vertex % rows_in_block); });
        patch[block].each([&](const OldRow<Row>& old) {
            if (!is_there.test(old.vertex % rows_in_block)) opened[block].push(old);
        });
    });
}

// Keeps the rows of a patch that held no start before, and notes what all of them hold.
template<std::size_t places, typename Row>
void keep(OldRows<Row>&& patch, const std::vector<Row>& rows, AddedStarts<places>& added, Workers& workers) {
    auto& without = std::get<OldRows<Row>>(added.without.blocks);
    const auto is_added = [&](Index number) { return number >= added.first_number && number != Row::none; };
    workers.for_each(patch.size(), blocks_at_once, [&](std::size_t block) {
        std::vector<Index>& numbers = added.numbers[block];
        const auto note = [&](const OldRow<Row>& old) {
            for (const Index number : rows[old.vertex].sample)
                if (is_added(number) && std::ranges::find(numbers, number) == numbers.end())
                    numbers.push_back(number);
        };
        const auto held_any = [&](const OldRow<Row>& old) {
            return std::ranges::any_of(old.sample, is_added);
        };
        patch[block].each(note);
        patch[block].erase_if(held_any);
        if (without[block].empty())
            without[block] = std::move(patch[block]);
        else
            patch[block].take([&](const OldRow<Row>& old) { without[block].push(old); });
    });
}

template<std::size_t places>
void widen(RowPatch<places>& patch) {
    using Narrow = typename NearestRows<places>::Narrow;
    using Wide = typename NearestRows<places>::Wide;
    const auto* narrow = std::get_if<OldRows<Narrow>>(&patch.blocks);
    if (!narrow) return;
    OldRows<Wide> wide(narrow->size());
    for (std::size_t block = 0; block < wide.size(); ++block)
        (*narrow)[block].each([&](const OldRow<Narrow>& old) {
            const Wide row = widened(Narrow{old.sample, old.distance});
            wide[block].push({old.vertex, row.sample, row.distance});
        });
    patch.blocks = std::move(wide);
}

// Of as many blocks as the rows have, and narrow where they are.
template<std::size_t places>
RowPatch<places> empty_patch(const NearestRows<places>& nearest) {
    return std::visit(
        []<typename Row>(const std::vector<Row>& rows) {
            return RowPatch<places>{OldRows<Row>(blocks_of_rows(rows.size()))};
        },
        nearest.rows);
}

template<std::size_t places>
void mark(const RowPatch<places>& patch, std::span<std::uint8_t> changed) {
    const auto mark_all = [&](const auto& blocks) {
        for (std::size_t block = 0; block < blocks.size(); ++block)
            if (!blocks[block].empty()) changed[block] = 1;
    };
    std::visit(mark_all, patch.blocks);
}

// See change_starts(). Who asks to be told is: opened(patch) of rows that something was taken out of, as they
// were; flooded(patch) of those that the flood changed, as they were before it.
template<std::size_t places, typename Opened, typename Flooded>
void change(AddedStarts<places>& added, std::span<const FloodStart> starts, NearestRows<places>& nearest,
            const Surface& along, Workers& workers, Progress& progress, Opened&& opened, Flooded&& flooded) {
    Starts wanted(starts.begin(), starts.end());
    std::ranges::sort(wanted, by_number);
    require(wanted.empty() || wanted.front().number >= added.first_number, "starts have their own numbers");
    const Gone gone = gone_numbers(added, wanted);

    Starts coming;
    const auto comes = [&](const FloodStart& one) {
        return is_in(gone, one.number - added.first_number) ||
               !std::ranges::binary_search(added.starts, one, by_number);
    };
    std::ranges::copy_if(wanted, std::back_inserter(coming), comes);
    if (!gone.empty())
        std::visit(
            [&]<typename Row>(std::vector<Row>& rows) {
                auto& without = std::get<OldRows<Row>>(added.without.blocks);
                const StartChange<Row> start_change(rows, without, added.first_number, gone);
                opened(RowPatch<places>{take_out(start_change, std::span(added.numbers), added.first_number,
                                                 gone, along, workers, coming)});
            },
            nearest.rows);
    if (!coming.empty()) {
        RowPatch<places> patch = add_starts(nearest, along.graph, along.lengths, coming, workers, progress);
        flooded(patch);
        if (nearest.are_wide()) widen(added.without);
        std::visit(
            [&]<typename Row>(const std::vector<Row>& rows) {
                keep(std::get<OldRows<Row>>(std::move(patch.blocks)), rows, added, workers);
            },
            nearest.rows);
    }
    added.starts = std::move(wanted);
}

} // namespace

template<std::size_t places>
AddedStarts<places> no_starts(const NearestRows<places>& nearest, Index first_number) {
    return {first_number,
            {},
            empty_patch(nearest),
            std::vector<std::vector<Index>>(blocks_of_rows(nearest.size()))};
}

void change_starts(AddedStarts<influences_per_row>& added, std::span<const FloodStart> starts,
                   InfluenceRows& nearest, std::span<std::uint8_t> changed, const Graph& graph,
                   std::span<const std::uint8_t> lengths, Workers& workers, Progress& progress) {
    require(changed.size() == blocks_of_rows(nearest.size()), "a byte a block of rows");
    const auto mark_them = [&](const FloodPatch& patch) { mark(patch, changed); };
    change(added, starts, nearest, {graph, lengths}, workers, progress, mark_them, mark_them);
}

TerritoryPatch change_starts(AddedStarts<1>& added, std::span<const FloodStart> starts,
                             TerritoryRows& nearest, const Graph& graph,
                             std::span<const std::uint8_t> lengths, Workers& workers, Progress& progress) {
    TerritoryPatch before = empty_patch(nearest);
    const auto opened = [&](TerritoryPatch&& patch) { before = std::move(patch); };
    const auto flooded = [&](const TerritoryPatch& patch) {
        if (nearest.are_wide()) widen(before);
        std::visit(
            [&]<typename Row>(const OldRows<Row>& blocks) {
                put_beside(blocks, std::get<OldRows<Row>>(before.blocks), workers);
            },
            patch.blocks);
    };
    change(added, starts, nearest, {graph, lengths}, workers, progress, opened, flooded);
    return before;
}

template<std::size_t places>
std::vector<SampleRow<Index, places>> rows_without(const AddedStarts<places>& added,
                                                   const NearestRows<places>& nearest,
                                                   std::span<const Index> vertices) {
    std::vector<SampleRow<Index, places>> rows = rows_at(nearest, vertices);
    std::visit(
        [&]<typename Row>(const std::vector<Pile<OldRow<Row>>>& without) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const auto is_it = [&](const OldRow<Row>& old) { return old.vertex == vertices[i]; };
                if (const auto* old = without[vertices[i] / rows_in_block].find_if(is_it))
                    rows[i] = widened(Row{old->sample, old->distance});
            }
        },
        added.without.blocks);
    return rows;
}

template AddedStarts<1> no_starts(const TerritoryRows&, Index);
template AddedStarts<influences_per_row> no_starts(const NearestRows<influences_per_row>&, Index);
template std::vector<SampleRow<Index, 1>> rows_without(const AddedStarts<1>&, const TerritoryRows&,
                                                       std::span<const Index>);
template std::vector<WideRow> rows_without(const AddedStarts<influences_per_row>&,
                                           const NearestRows<influences_per_row>&, std::span<const Index>);

} // namespace knead

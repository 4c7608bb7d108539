#include "graph/starts_flood.h"

#include "base/gathered.h"
#include "base/require.h"

#include <algorithm>
#include <array>
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
Gone gone_numbers(const AddedStarts& added, const Starts& starts) {
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

// Changes the rows of one kind.
template<typename Row>
class StartChange {
public:
    using Number = typename decltype(Row::sample)::value_type;

    StartChange(std::vector<Row>& rows, OldRows<Row>& without, Index first_number, const Gone& gone)
        : rows_(rows), without_(without), first_(first_number), gone_(gone) {}

    // Takes out of the rows of a block what is gone; `opened` receives the vertices of those that held any of
    // it.
    void take_out(std::size_t block, std::vector<Index>& opened) const {
        auto& kept = without_[block];
        const auto is_left_alone = [&](const OldRow<Row>& old) {
            Row& row = rows_[old.vertex];
            if (std::ranges::none_of(row.sample, [&](Number s) { return is_gone(s); })) return false;
            opened.push_back(old.vertex);
            return !replace(row, Row{old.sample, old.distance});
        };
        kept.erase_if(is_left_alone);
    }

    // What neighbours hold of other starts and an opened row has room for.
    template<typename Add>
    void reach_again(Index vertex, const Graph& graph, std::span<const std::uint8_t> lengths,
                     Add&& add) const {
        const Row& row = rows_[vertex];
        for (Index link = graph.first[vertex]; link < graph.first[vertex + 1]; ++link) {
            const Row& there = rows_[graph.neighbor[link]];
            if (!holds_added(there)) continue;
            for (std::size_t k = 0; k < there.count(); ++k) {
                if (there.sample[k] < first_) continue;
                const std::uint64_t distance = std::uint64_t{there.distance[k]} + lengths[link];
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
        std::array<std::pair<Number, Number>, 2 * influences_per_row> all; // (distance, number)
        std::size_t count = 0;
        for (std::size_t k = 0; k < row.sample.size(); ++k)
            if (is_added(row.sample[k]) && !is_gone(row.sample[k]))
                all[count++] = {row.distance[k], row.sample[k]};
        const bool any = count > 0;
        for (std::size_t k = 0; k < base.sample.size(); ++k)
            all[count++] = {base.distance[k], base.sample[k]};
        std::sort(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count)); // empty places are last
        for (std::size_t k = 0; k < row.sample.size(); ++k) std::tie(row.distance[k], row.sample[k]) = all[k];
        return any;
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
template<typename Row>
void take_out(StartChange<Row> change, std::span<std::vector<Index>> numbers, Index first_number,
              const Gone& gone, std::span<std::uint8_t> changed, const Graph& graph,
              std::span<const std::uint8_t> lengths, Workers& workers, Starts& starts) {
    std::vector<std::vector<Index>> opened(changed.size());
    workers.for_each(changed.size(), blocks_at_once, [&](std::size_t block) {
        const auto is_gone = [&](Index number) { return is_in(gone, number - first_number); };
        if (std::erase_if(numbers[block], is_gone) > 0) change.take_out(block, opened[block]);
        if (!opened[block].empty()) changed[block] = 1;
    });
    Gathered<FloodStart> found;
    workers.for_chunks(changed.size(), blocks_at_once, [&](std::size_t begin, std::size_t end) {
        Gathered<FloodStart>::Block here(found);
        for (std::size_t block = begin; block < end; ++block)
            for (const Index vertex : opened[block])
                change.reach_again(vertex, graph, lengths, [&](const FloodStart& one) { here.push(one); });
    });
    found.take([&](const FloodStart& one) { starts.push_back(one); });
}

// Keeps the rows of a patch that held no start before, and notes what all of them hold.
template<typename Row>
void keep(OldRows<Row>&& patch, const std::vector<Row>& rows, AddedStarts& added,
          std::span<std::uint8_t> changed, Workers& workers) {
    auto& without = std::get<OldRows<Row>>(added.without);
    const auto is_added = [&](Index number) { return number >= added.first_number && number != Row::none; };
    workers.for_each(patch.size(), blocks_at_once, [&](std::size_t block) {
        if (patch[block].empty()) return;
        changed[block] = 1;
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

void widen(AddedStarts& added) {
    const auto* narrow = std::get_if<OldRows<NarrowRow>>(&added.without);
    if (!narrow) return;
    OldRows<WideRow> wide(narrow->size());
    for (std::size_t block = 0; block < wide.size(); ++block)
        (*narrow)[block].each([&](const OldRow<NarrowRow>& old) {
            const WideRow row = widened(NarrowRow{old.sample, old.distance});
            wide[block].push({old.vertex, row.sample, row.distance});
        });
    added.without = std::move(wide);
}

} // namespace

AddedStarts no_starts(const InfluenceRows& nearest, Index first_number) {
    const std::size_t blocks = blocks_of_rows(nearest.size());
    AddedStarts added{first_number, {}, {}, std::vector<std::vector<Index>>(blocks)};
    if (nearest.are_wide())
        added.without = OldRows<WideRow>(blocks);
    else
        added.without = OldRows<NarrowRow>(blocks);
    return added;
}

void change_starts(AddedStarts& added, std::span<const FloodStart> starts, InfluenceRows& nearest,
                   std::span<std::uint8_t> changed, const Graph& graph, std::span<const std::uint8_t> lengths,
                   Workers& workers, Progress& progress) {
    require(changed.size() == blocks_of_rows(nearest.size()), "a byte a block of rows");
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
                auto& without = std::get<OldRows<Row>>(added.without);
                take_out(StartChange<Row>(rows, without, added.first_number, gone), added.numbers,
                         added.first_number, gone, changed, graph, lengths, workers, coming);
            },
            nearest.rows);
    if (!coming.empty()) {
        FloodPatch patch = add_starts(nearest, graph, lengths, coming, workers, progress);
        if (nearest.are_wide()) widen(added);
        std::visit(
            [&]<typename Row>(const std::vector<Row>& rows) {
                keep<Row>(std::get<OldRows<Row>>(std::move(patch.blocks)), rows, added, changed, workers);
            },
            nearest.rows);
    }
    added.starts = std::move(wanted);
}

std::vector<WideRow> rows_without(const AddedStarts& added, const InfluenceRows& nearest,
                                  std::span<const Index> vertices) {
    std::vector<WideRow> rows = rows_at(nearest, vertices);
    std::visit(
        [&]<typename Row>(const OldRows<Row>& without) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const auto is_it = [&](const OldRow<Row>& old) { return old.vertex == vertices[i]; };
                if (const auto* old = without[vertices[i] / rows_in_block].find_if(is_it))
                    rows[i] = widened(Row{old->sample, old->distance});
            }
        },
        added.without);
    return rows;
}

} // namespace knead

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

// Which numbers go: those that some start of is no longer there.
std::vector<bool> gone_numbers(const AddedStarts& added, const Starts& starts) {
    std::vector<bool> is_gone;
    for (auto one = added.starts.begin(); one != added.starts.end(); ++one) {
        if (std::ranges::binary_search(starts, *one, by_number)) continue;
        is_gone.resize(std::max(is_gone.size(), std::size_t{one->number - added.first_number} + 1), false);
        is_gone[one->number - added.first_number] = true;
    }
    return is_gone;
}

// Changes the rows of one kind.
template<typename Row>
class StartChange {
public:
    using Number = typename decltype(Row::sample)::value_type;

    StartChange(std::vector<Row>& rows, AddedStarts::Kept<Row>& without, Index first_number,
                const std::vector<bool>& is_gone)
        : rows_(rows), without_(without), first_(first_number), is_gone_(is_gone) {}

    // Takes out of the rows of a block what is gone; `opened` receives the vertices of those that held any of
    // it.
    void take_out(std::size_t block, std::vector<Index>& opened) const {
        auto& kept = without_[block];
        std::size_t stay = 0;
        for (const OldRow<Row>& old : kept) {
            Row& row = rows_[old.vertex];
            const bool loses = std::ranges::any_of(row.sample, [&](Number s) { return is_gone(s); });
            if (loses) {
                opened.push_back(old.vertex);
                if (!replace(row, Row{old.sample, old.distance})) continue; // nothing is left but that
            }
            kept[stay++] = old;
        }
        kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(stay), kept.end());
    }

    // What neighbours hold of other starts and an opened row has room for.
    template<typename Add>
    void reach_again(Index vertex, const Graph& graph, std::span<const std::uint8_t> lengths,
                     Add&& add) const {
        const Row& row = rows_[vertex];
        for (Index link = graph.first[vertex]; link < graph.first[vertex + 1]; ++link) {
            const Row& there = rows_[graph.neighbor[link]];
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
    bool is_gone(Number number) const {
        return is_added(number) && number - first_ < is_gone_.size() && is_gone_[number - first_];
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
    AddedStarts::Kept<Row>& without_;
    Index first_;
    const std::vector<bool>& is_gone_;
};

// Takes what is gone out of the rows, and adds to `starts` where the others come from to fill them again.
template<typename Row>
void take_out(StartChange<Row> change, std::span<std::uint8_t> changed, const Graph& graph,
              std::span<const std::uint8_t> lengths, Workers& workers, Starts& starts) {
    std::vector<std::vector<Index>> opened(changed.size());
    workers.for_each(changed.size(), blocks_at_once, [&](std::size_t block) {
        change.take_out(block, opened[block]);
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

// Keeps the rows of a patch that held no start before.
template<typename Row>
void keep(const OldRows<Row>& patch, Index first_number, AddedStarts::Kept<Row>& without,
          std::span<std::uint8_t> changed) {
    for (const auto& block : patch)
        for (const OldRow<Row>& old : block) {
            changed[old.vertex / rows_in_block] = 1;
            const bool held =
                std::ranges::any_of(old.sample, [&](auto s) { return s >= first_number && s != Row::none; });
            if (!held) without[old.vertex / rows_in_block].push_back(old);
        }
}

void widen(AddedStarts& added) {
    const auto* narrow = std::get_if<AddedStarts::Kept<NarrowRow>>(&added.without);
    if (!narrow) return;
    AddedStarts::Kept<WideRow> wide(narrow->size());
    for (std::size_t block = 0; block < wide.size(); ++block)
        for (const auto& old : (*narrow)[block]) {
            const WideRow row = widened(NarrowRow{old.sample, old.distance});
            wide[block].push_back({old.vertex, row.sample, row.distance});
        }
    added.without = std::move(wide);
}

} // namespace

AddedStarts no_starts(const InfluenceRows& nearest, Index first_number) {
    AddedStarts added{first_number, {}, {}};
    const std::size_t blocks = blocks_of_rows(nearest.size());
    if (nearest.are_wide())
        added.without = AddedStarts::Kept<WideRow>(blocks);
    else
        added.without = AddedStarts::Kept<NarrowRow>(blocks);
    return added;
}

void change_starts(AddedStarts& added, std::span<const FloodStart> starts, InfluenceRows& nearest,
                   std::span<std::uint8_t> changed, const Graph& graph, std::span<const std::uint8_t> lengths,
                   Workers& workers, Progress& progress) {
    require(changed.size() == blocks_of_rows(nearest.size()), "a byte a block of rows");
    Starts wanted(starts.begin(), starts.end());
    std::ranges::sort(wanted, by_number);
    require(wanted.empty() || wanted.front().number >= added.first_number, "starts have their own numbers");
    const std::vector<bool> is_gone = gone_numbers(added, wanted);

    Starts coming;
    const auto comes = [&](const FloodStart& one) {
        const Index number = one.number - added.first_number;
        return (number < is_gone.size() && is_gone[number]) ||
               !std::ranges::binary_search(added.starts, one, by_number);
    };
    std::ranges::copy_if(wanted, std::back_inserter(coming), comes);
    if (!is_gone.empty())
        std::visit(
            [&]<typename Row>(std::vector<Row>& rows) {
                auto& without = std::get<AddedStarts::Kept<Row>>(added.without);
                take_out(StartChange<Row>(rows, without, added.first_number, is_gone), changed, graph,
                         lengths, workers, coming);
            },
            nearest.rows);
    if (!coming.empty()) {
        const FloodPatch patch = add_starts(nearest, graph, lengths, coming, workers, progress);
        if (nearest.are_wide()) widen(added);
        std::visit(
            [&]<typename Row>(const OldRows<Row>& blocks) {
                keep<Row>(blocks, added.first_number, std::get<AddedStarts::Kept<Row>>(added.without),
                          changed);
            },
            patch.blocks);
    }
    added.starts = std::move(wanted);
}

std::vector<WideRow> rows_without(const AddedStarts& added, const InfluenceRows& nearest,
                                  std::span<const Index> vertices) {
    std::vector<WideRow> rows = rows_at(nearest, vertices);
    std::visit(
        [&]<typename Row>(const std::vector<std::vector<OldRow<Row>>>& without) {
            for (std::size_t i = 0; i < rows.size(); ++i) {
                const auto& block = without[vertices[i] / rows_in_block];
                const auto old = std::ranges::find(block, vertices[i], &OldRow<Row>::vertex);
                if (old != block.end()) rows[i] = widened(Row{old->sample, old->distance});
            }
        },
        added.without);
    return rows;
}

} // namespace knead

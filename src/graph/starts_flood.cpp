#include "graph/starts_flood.h"

#include "base/paged.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace knead {

namespace {

using Starts = std::vector<FloodStart>;

constexpr auto by_number = [](const FloodStart& a, const FloodStart& b) {
    return std::pair(a.number, a.vertex) < std::pair(b.number, b.vertex);
};

Starts without(const Starts& starts, const Starts& others) {
    Starts rest;
    std::ranges::set_difference(starts, others, std::back_inserter(rest), by_number);
    return rest;
}

Starts common(const Starts& starts, const Starts& others) {
    Starts both;
    std::ranges::set_intersection(starts, others, std::back_inserter(both), by_number);
    return both;
}

void mark(const FloodPatch& patch, std::span<std::uint8_t> changed) {
    std::visit(
        [&](const auto& blocks) {
            for (const auto& block : blocks)
                for (const auto& old : block) changed[old.vertex / rows_in_block] = 1;
        },
        patch.blocks);
}

} // namespace

void change_starts(std::vector<StartsFlood<influences_per_row>>& floods, std::span<const FloodStart> starts,
                   InfluenceRows& nearest, std::span<std::uint8_t> changed, const Graph& graph,
                   std::span<const std::uint8_t> lengths, Workers& workers, Progress& progress) {
    require(changed.size() == blocks_of_rows(nearest.size()), "a byte a block of rows");
    Starts rest(starts.begin(), starts.end());
    std::ranges::sort(rest, by_number);
    std::size_t stay = 0;
    for (; stay < floods.size() && std::ranges::includes(rest, floods[stay].starts, by_number); ++stay)
        rest = without(rest, floods[stay].starts);

    Starts gone;
    for (; floods.size() > stay; floods.pop_back()) {
        gone.insert(gone.end(), floods.back().starts.begin(), floods.back().starts.end());
        mark(floods.back().patch, changed);
        revert(nearest, floods.back().patch);
    }
    std::ranges::sort(gone, by_number);

    std::array parts{common(rest, gone), without(rest, gone)};
    for (Starts& part : parts) {
        if (part.empty()) continue;
        FloodPatch patch = add_starts(nearest, graph, lengths, part, workers, progress);
        mark(patch, changed);
        floods.push_back({std::move(part), std::move(patch)});
    }
}

template<std::size_t places>
std::vector<SampleRow<Index, places>> rows_without(std::span<const StartsFlood<places>> floods,
                                                   const NearestRows<places>& nearest,
                                                   std::span<const Index> vertices, Workers& workers) {
    std::vector<SampleRow<Index, places>> rows = rows_at(nearest, vertices);
    Paged<Index> place(nearest.size(), no_index);
    for (Index at = 0; at < vertices.size(); ++at) {
        place.make_room(vertices[at]);
        place.set(vertices[at], at);
    }
    const auto before = [&]<typename Row>(const OldRows<Row>& blocks) {
        workers.for_each(blocks.size(), 16, [&](std::size_t block) {
            for (const OldRow<Row>& old : blocks[block])
                if (const Index at = place[old.vertex]; at != no_index)
                    rows[at] = widened(Row{old.sample, old.distance});
        });
    };
    for (auto flood = floods.rbegin(); flood != floods.rend(); ++flood)
        std::visit(before, flood->patch.blocks);
    return rows;
}

template std::vector<WideRow> rows_without(std::span<const StartsFlood<influences_per_row>> floods,
                                           const NearestRows<influences_per_row>& nearest,
                                           std::span<const Index> vertices, Workers& workers);
template std::vector<SampleRow<Index, 1>> rows_without(std::span<const StartsFlood<1>> floods,
                                                       const NearestRows<1>& nearest,
                                                       std::span<const Index> vertices, Workers& workers);

} // namespace knead

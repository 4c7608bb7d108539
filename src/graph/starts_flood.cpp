#include "graph/starts_flood.h"

#include "base/paged.h"
#include "base/require.h"

#include <algorithm>

namespace knead {

namespace {

bool begins_with(std::span<const FloodStart> starts, std::span<const FloodStart> others) {
    return starts.size() >= others.size() && std::ranges::equal(starts.first(others.size()), others);
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
    std::span<const FloodStart> rest = starts;
    std::size_t stay = 0;
    for (; stay < floods.size() && begins_with(rest, floods[stay].starts); ++stay)
        rest = rest.subspan(floods[stay].starts.size());

    std::vector<FloodStart> gone;
    for (std::size_t f = stay; f < floods.size(); ++f)
        gone.insert(gone.end(), floods[f].starts.begin(), floods[f].starts.end());
    for (; floods.size() > stay; floods.pop_back()) {
        mark(floods.back().patch, changed);
        revert(nearest, floods.back().patch);
    }

    const auto same = static_cast<std::size_t>(std::ranges::mismatch(rest, gone).in1 - rest.begin());
    for (const auto part : {rest.first(same), rest.subspan(same)}) {
        if (part.empty()) continue;
        floods.push_back(
            {{part.begin(), part.end()}, add_starts(nearest, graph, lengths, part, workers, progress)});
        mark(floods.back().patch, changed);
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

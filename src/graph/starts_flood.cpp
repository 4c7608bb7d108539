#include "graph/starts_flood.h"

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

void change_starts(std::vector<StartsFlood>& floods, std::span<const FloodStart> starts,
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

} // namespace knead

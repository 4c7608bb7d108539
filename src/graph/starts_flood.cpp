#include "graph/starts_flood.h"

#include <algorithm>

namespace knead {

namespace {

bool begins_with(std::span<const FloodStart> starts, std::span<const FloodStart> others) {
    return starts.size() >= others.size() && std::ranges::equal(starts.first(others.size()), others);
}

} // namespace

void change_starts(std::vector<StartsFlood>& floods, std::span<const FloodStart> starts,
                   InfluenceRows& nearest, const Graph& graph, std::span<const std::uint8_t> lengths,
                   Workers& workers, Progress& progress) {
    std::span<const FloodStart> rest = starts;
    std::size_t stay = 0;
    for (; stay < floods.size() && begins_with(rest, floods[stay].starts); ++stay)
        rest = rest.subspan(floods[stay].starts.size());

    std::vector<FloodStart> gone;
    for (std::size_t f = stay; f < floods.size(); ++f)
        gone.insert(gone.end(), floods[f].starts.begin(), floods[f].starts.end());
    for (; floods.size() > stay; floods.pop_back()) revert(nearest, floods.back().patch);

    const auto same = static_cast<std::size_t>(std::ranges::mismatch(rest, gone).in1 - rest.begin());
    for (const auto part : {rest.first(same), rest.subspan(same)})
        if (!part.empty())
            floods.push_back(
                {{part.begin(), part.end()}, add_starts(nearest, graph, lengths, part, workers, progress)});
}

} // namespace knead

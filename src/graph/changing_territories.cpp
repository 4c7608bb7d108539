#include "graph/changing_territories.h"

#include <algorithm>

namespace knead {

ChangingTerritories territories_of_base(const InfluenceRows& nearest, const Graph& points, Workers& workers) {
    ChangingTerritories territories;
    territories.nearest = territory_rows(nearest, workers);
    territories.borders = {territory_borders(territories.nearest, points, workers)};
    return territories;
}

std::span<const TerritoryBorder> change_added(ChangingTerritories& territories,
                                              std::vector<std::vector<FloodStart>> added, const Graph& points,
                                              std::span<const std::uint8_t> lengths, Workers& workers,
                                              Progress& progress) {
    auto& [nearest, borders, floods] = territories;
    const auto last_same = std::ranges::mismatch(floods, added, {}, &StartsFlood<1>::starts).in1;
    const auto stay = static_cast<std::size_t>(last_same - floods.begin());
    for (; floods.size() > stay; floods.pop_back(), borders.pop_back()) revert(nearest, floods.back().patch);
    for (std::size_t f = stay; f < added.size(); ++f) {
        TerritoryPatch patch = add_territories(nearest, points, lengths, added[f], workers, progress);
        floods.push_back({std::move(added[f]), std::move(patch)});
        borders.push_back(
            territory_borders_after(borders.back(), floods.back().patch, nearest, points, lengths, workers));
    }
    return borders.back();
}

std::vector<Index> nearest_of_base(const ChangingTerritories& territories, std::span<const Index> vertices,
                                   Workers& workers) {
    const auto rows = rows_without<1>(territories.floods, territories.nearest, vertices, workers);
    std::vector<Index> samples(rows.size());
    std::ranges::transform(rows, samples.begin(), [](const auto& row) { return row.sample[0]; });
    return samples;
}

} // namespace knead

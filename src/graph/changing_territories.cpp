#include "graph/changing_territories.h"

#include "base/paged.h"

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
    const auto last_same = std::ranges::mismatch(floods, added, {}, &TerritoryFlood::starts).in1;
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
    std::vector<Index> samples(vertices.size());
    std::ranges::transform(vertices, samples.begin(),
                           [&](Index v) { return territories.nearest[v].sample[0]; });
    Paged<Index> place(territories.nearest.size(), no_index);
    for (Index at = 0; at < vertices.size(); ++at) {
        place.make_room(vertices[at]);
        place.set(vertices[at], at);
    }
    const auto before = [&]<typename Row>(const OldRows<Row>& blocks) {
        workers.for_each(blocks.size(), 64, [&](std::size_t block) {
            blocks[block].each([&](const OldRow<Row>& old) {
                if (const Index at = place[old.vertex]; at != no_index)
                    samples[at] = widened(Row{old.sample, old.distance}).sample[0];
            });
        });
    };
    for (auto flood = territories.floods.rbegin(); flood != territories.floods.rend(); ++flood)
        std::visit(before, flood->patch.blocks);
    return samples;
}

} // namespace knead

#include "graph/changing_territories.h"

#include "graph/kept_numbers.h"

#include <algorithm>

namespace knead {

namespace {

// Up to which numbers go: as far as narrow rows can tell, if they can tell so many.
Index end_of_numbers(std::size_t samples) {
    constexpr Index narrow = TerritoryRows::Narrow::none;
    return samples < narrow ? narrow : no_index - 1;
}

// Starts of these samples, ascending.
std::vector<FloodStart> starts_of_added(const AddedStarts<1>& before, std::span<const Index> added) {
    std::vector<Numbered> former;
    for (const FloodStart& start : before.starts) former.push_back({start.vertex, start.number});
    const Index first = before.first_number;
    const std::vector<Index> numbers =
        kept_numbers(former, added, first, end_of_numbers(first + added.size()));
    std::vector<FloodStart> starts;
    for (std::size_t i = 0; i < added.size(); ++i) starts.push_back({added[i], numbers[i]});
    return starts;
}

// Which sample has this number of its own; no_index has none.
Index sample_of(const AddedStarts<1>& added, Index number) {
    if (number < added.first_number || number == no_index) return number;
    const auto start = std::ranges::lower_bound(added.starts, number, {}, &FloodStart::number);
    return added.first_number + static_cast<Index>(start - added.starts.begin());
}

} // namespace

ChangingTerritories territories_of_base(const InfluenceRows& nearest, std::size_t base, const Graph& points,
                                        Workers& workers) {
    ChangingTerritories territories;
    territories.nearest = territory_rows(nearest, workers);
    territories.added = no_starts(territories.nearest, static_cast<Index>(base));
    territories.borders = territory_borders(territories.nearest, points, workers);
    territories.base_borders = territories.borders;
    return territories;
}

std::vector<TerritoryBorder> change_added(ChangingTerritories& territories, std::span<const Index> added,
                                          const Graph& points, std::span<const std::uint8_t> lengths,
                                          Workers& workers, Progress& progress) {
    TerritoryRows& nearest = territories.nearest;
    AddedStarts<1>& starts = territories.added;
    const std::vector<FloodStart> wanted = starts_of_added(starts, added);
    const TerritoryPatch former = change_starts(starts, wanted, nearest, points, lengths, workers, progress);
    territories.borders =
        territory_borders_after(territories.borders, former, starts, nearest, points, lengths, workers);

    std::vector<TerritoryBorder> result = territories.borders;
    for (TerritoryBorder& border : result) {
        border.a = sample_of(starts, border.a);
        border.b = sample_of(starts, border.b);
    }
    return result;
}

std::vector<Index> nearest_samples(const ChangingTerritories& territories, std::span<const Index> vertices,
                                   Workers& workers) {
    std::vector<Index> samples(vertices.size());
    workers.for_each(vertices.size(), 4096, [&](std::size_t k) {
        samples[k] = sample_of(territories.added, territories.nearest[vertices[k]].sample[0]);
    });
    return samples;
}

std::vector<Index> nearest_of_base(const ChangingTerritories& territories, std::span<const Index> vertices) {
    const auto rows = rows_without(territories.added, territories.nearest, vertices);
    std::vector<Index> samples(vertices.size());
    std::ranges::transform(rows, samples.begin(), [](const auto& row) { return row.sample[0]; });
    return samples;
}

} // namespace knead

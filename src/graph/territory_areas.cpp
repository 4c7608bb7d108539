#include "graph/territory_areas.h"

#include "base/require.h"

#include <span>

namespace knead {

namespace {

// A vertex whose star says so many times more than those around on the mean is no example for them: a stray
// that none took for one, or of a much sparser part.
constexpr double no_example = 4;

// Of the asked vertices of a territory.
struct Sums {
    double area = 0, star = 0, links = 0, vertices = 0;

    void add(const AskedVertices& asked, std::size_t k) {
        const double each = asked.each[k];
        area += each * asked.area[k];
        star += each * asked.star[k];
        links += each * asked.links[k];
        vertices += each;
    }

    void add(const Sums& other) {
        area += other.area;
        star += other.star;
        links += other.links;
        vertices += other.vertices;
    }
};

// Those of each territory and all that touch it; of the asked vertices for which counts(k, its sample) holds.
template<typename Counts>
std::vector<Sums> sums_around(const AskedVertices& asked, std::span<const Index> sample,
                              std::span<const TerritoryBorder> borders, std::size_t samples,
                              Counts&& counts) {
    std::vector<Sums> own(samples);
    for (std::size_t k = 0; k < sample.size(); ++k)
        if (sample[k] < samples && counts(k, sample[k])) own[sample[k]].add(asked, k);
    std::vector<Sums> sums = own;
    for (const TerritoryBorder& border : borders) {
        sums[border.a].add(own[border.b]);
        sums[border.b].add(own[border.a]);
    }
    return sums;
}

float ratio(double of, double to) {
    return of > 0 && to > 0 ? static_cast<float>(of / to) : 1;
}

} // namespace

std::vector<float> level_areas(AskedVertices& asked, const ChangingTerritories& territories,
                               std::size_t base_samples) {
    const std::vector<Index> sample = nearest_of_base(territories, asked.vertex);
    const std::vector<Sums> all = sums_around(asked, sample, territories.base_borders, base_samples,
                                              [](std::size_t, Index) { return true; });
    const auto is_example = [&](std::size_t k, Index s) {
        return asked.area[k] >= 0 && asked.star[k] * all[s].vertices <= no_example * all[s].star;
    };
    const std::vector<Sums> sums =
        sums_around(asked, sample, territories.base_borders, base_samples, is_example);
    for (std::size_t k = 0; !asked.all && k < sample.size(); ++k) {
        const bool has_base = sample[k] < base_samples; // some parts have added samples alone
        asked.area[k] =
            asked.star[k] *
            (has_base ? static_cast<double>(ratio(sums[sample[k]].area, sums[sample[k]].star)) : 1);
    }
    std::vector<float> of_links;
    of_links.reserve(base_samples);
    for (const Sums& each : sums) of_links.push_back(ratio(each.area, each.links));
    return of_links;
}

std::vector<double> territory_areas(const AskedVertices& asked, const ChangingTerritories& territories,
                                    std::size_t samples, Workers& workers) {
    const std::vector<Index> sample = nearest_samples(territories, asked.vertex, workers);
    std::vector<double> area(samples, 0.0);
    for (std::size_t k = 0; k < sample.size(); ++k) {
        if (sample[k] == no_index) continue;
        require(sample[k] < samples, "territories are those of the samples");
        area[sample[k]] += asked.each[k] * asked.area[k];
    }
    return area;
}

} // namespace knead

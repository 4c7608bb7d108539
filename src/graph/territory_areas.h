#pragma once
// How much of the surface each sample stands for.

#include "base/workers.h"
#include "graph/changing_territories.h"
#include "graph/vertex_areas.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace knead {

// So many of `all` vertices are to be asked for so many samples, one of `of_cells` for its cell; more change
// little.
struct Asking {
    std::size_t vertices, of_cells;
};
constexpr Asking asking_for(std::size_t samples, std::size_t all) {
    constexpr std::size_t a_sample = 16, fewest = 8192, few_samples = 2000;
    const std::size_t wanted = std::max(a_sample * samples, fewest);
    if (wanted >= all) return {all, 1};
    return {wanted, samples <= few_samples ? 1U : 2U};
}

// Gives an area to those of the vertices that were not asked for their cell. Their star, which all have,
// tells an area as well, but one that is wrong by a factor which depends on how the points lie around. So
// that factor, area of cells over area of stars, is measured over the territory of each base sample and those
// beside it, since single cells differ too much, and multiplies the star; unless all were asked, it gives the
// area of those that were, too. Samples that were added change nothing of it. Returns of the same territories
// the area of the cells over what the links there tell, one entry a base sample; 1 where nothing was asked.
std::vector<float> level_areas(AskedVertices& asked, const ChangingTerritories& territories,
                               std::size_t base_samples);

// The areas of the vertices in the territory of each of so many samples, base samples and added ones; 0 where
// none of them was asked. The same for any number of workers.
std::vector<double> territory_areas(const AskedVertices& asked, const ChangingTerritories& territories,
                                    std::size_t samples, Workers& workers);

} // namespace knead

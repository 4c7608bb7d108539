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

// Where not all vertices were asked, makes the area of each what its star says, times what areas are of stars
// over the territory of its base sample and those beside it: cells differ too much for some to tell what
// others are. Areas are known of all then. Samples that were added change nothing of it. Returns the same
// ratio of areas to what links say, one entry a base sample; 1 where nothing was asked.
std::vector<float> level_areas(AskedVertices& asked, const ChangingTerritories& territories,
                               std::size_t base_samples);

// The areas of the vertices in the territory of each of so many samples, base samples and added ones; 0 where
// none of them was asked. The same for any number of workers.
std::vector<double> territory_areas(const AskedVertices& asked, const ChangingTerritories& territories,
                                    std::size_t samples, Workers& workers);

} // namespace knead

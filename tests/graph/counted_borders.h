#pragma once
// Borders of territories counted in the plainest way, the yardstick for those that are followed.

#include "graph/clouds.h"
#include "graph/territory_borders.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace knead::test {

// Counted for every link from both ends, in the plainest way. Samples from `first_added` on were added.
inline std::vector<TerritoryBorder> counted(const Cloud& cloud, const TerritoryRows& nearest,
                                            Index first_added = no_index) {
    std::map<std::pair<Index, Index>, TerritoryBorder> borders;
    for (Index p = 0; p < cloud.size(); ++p)
        for (Index link = cloud.graph.first[p]; link < cloud.graph.first[p + 1]; ++link) {
            const TerritoryRows::Wide here = nearest[p], there = nearest[cloud.graph.neighbor[link]];
            const Index a = here.sample[0], b = there.sample[0];
            if (!(a < b)) continue;
            TerritoryBorder& border = borders[{a, b}];
            border.a = a;
            border.b = b;
            ++border.links;
            if (b >= first_added)
                border.way = std::min(border.way, here.distance[0] + cloud.lengths[link] + there.distance[0]);
        }
    std::vector<TerritoryBorder> result;
    for (const auto& [pair, border] : borders) result.push_back(border);
    return result;
}

} // namespace knead::test

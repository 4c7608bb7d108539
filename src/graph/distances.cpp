#include "graph/distances.h"

#include "base/paged.h"
#include "base/require.h"
#include "base/types.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace knead {

std::vector<Reached> reached_within(const Graph& graph, std::span<const float> positions,
                                    std::span<const Index> sources, double limit,
                                    const std::atomic<bool>* stop) {
    require(positions.size() == 3 * graph.size(), "a position a vertex");
    using Waiting = std::pair<double, Index>;
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
    Paged<double> distance(graph.size(), std::numeric_limits<double>::infinity());
    Paged<Index> nearest(graph.size(), no_index);
    const auto come = [&](Index v, double way, Index source) {
        distance.make_room(v);
        distance.set(v, way);
        nearest.make_room(v);
        nearest.set(v, source);
    };
    std::vector<Reached> reached;
    for (const Index source : sources) {
        come(source, 0, source);
        reached.push_back({source, 0, source});
    }
    const auto go_on = [&](Index v, double way) {
        for (const Index u : graph.row(v)) {
            const double there = way + (point_at(positions, u) - point_at(positions, v)).norm();
            if (!(there < distance[u]) || there > limit) continue;
            come(u, there, nearest[v]);
            queue.emplace(there, u);
        }
    };
    for (const Index source : sources) go_on(source, 0);
    while (!queue.empty() && !(stop && *stop)) {
        const auto [way, v] = queue.top();
        queue.pop();
        if (way > distance[v]) continue; // a shorter way was found since
        reached.push_back({v, way, nearest[v]});
        go_on(v, way);
    }
    return reached;
}

} // namespace knead

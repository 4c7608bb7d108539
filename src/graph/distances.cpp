#include "graph/distances.h"

#include "base/require.h"
#include "base/types.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>

namespace knead {

std::vector<Reached> reached_within(const Graph& graph, std::span<const float> positions,
                                    std::span<const Index> sources, double limit) {
    require(positions.size() == 3 * graph.size(), "a position a vertex");
    using Waiting = std::pair<double, Index>;
    std::priority_queue<Waiting, std::vector<Waiting>, std::greater<>> queue;
    std::vector<double> distance(graph.size(), std::numeric_limits<double>::infinity());
    const auto offer = [&](Index v, double way) {
        if (!(way < distance[v]) || way > limit) return;
        distance[v] = way;
        queue.emplace(way, v);
    };
    for (const Index source : sources) offer(source, 0);
    std::vector<Reached> reached;
    while (!queue.empty()) {
        const auto [way, v] = queue.top();
        queue.pop();
        if (way > distance[v]) continue; // a shorter way was found since
        reached.push_back({v, way});
        for (const Index u : graph.row(v))
            offer(u, way + (point_at(positions, u) - point_at(positions, v)).norm());
    }
    return reached;
}

} // namespace knead

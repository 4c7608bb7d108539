#include "deform/least_turn.h"

#include "base/require.h"

#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace knead {

// Dijkstra's algorithm.
std::optional<double> least_turn(const SampleSystem& system, const SampleState& state,
                                 std::span<const WayEnd> ends) {
    const Graph& graph = system.rest.graph;
    require(ends.size() == graph.size() && state.rotation.size() == graph.size(), "a mark a sample");
    std::vector<double> turn(graph.size(), std::numeric_limits<double>::infinity());
    using Reached = std::pair<double, Index>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> next;
    for (Index s = 0; s < ends.size(); ++s)
        if (ends[s] == WayEnd::from) next.emplace(turn[s] = 0, s);
    while (!next.empty()) {
        const auto [so_far, s] = next.top();
        next.pop();
        if (so_far > turn[s]) continue;
        if (ends[s] == WayEnd::to) return so_far;
        for (const Index to : graph.row(s)) {
            const double further = so_far + state.rotation[s].angularDistance(state.rotation[to]);
            if (further < turn[to]) next.emplace(turn[to] = further, to);
        }
    }
    return std::nullopt;
}

} // namespace knead

#include "graph/nearest.h"

#include "base/types.h"

namespace knead {

namespace {

float distance_between(std::span<const float> positions, std::size_t v, std::size_t u) {
    return static_cast<float>((point_at(positions, v) - point_at(positions, u)).norm());
}

} // namespace

Nearest find_nearest(const Graph& graph, std::span<const float> positions, std::size_t v) {
    Nearest result;
    for (const Index u : graph.row(v)) {
        const std::pair<float, Index> next{distance_between(positions, v, u), u};
        std::size_t place = result.count;
        if (place == Nearest::most) {
            if (result.near.back() < next) continue;
            --place;
        } else {
            ++result.count;
        }
        for (; place > 0 && next < result.near[place - 1]; --place)
            result.near[place] = result.near[place - 1];
        result.near[place] = next;
    }
    return result;
}

} // namespace knead

#include "graph/local_spacing.h"

#include "graph/nearest.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr float most_over_neighbors = 2;
// On a line of points the fifth is three steps away, on a surface hardly farther than the second.
constexpr float most_over_second = 1.7F;
constexpr double nearly_all = 0.95; // of the vertices
constexpr float most_over_nearly_all = 2, most_over_half = 3;
constexpr std::size_t most_looked_at = 64; // links of a vertex; nearly all have fewer

// The median of a row's values, or of as many, evenly taken, as fit.
template<typename ValueOf>
float median_of(std::span<const Index> row, ValueOf&& value_of) {
    std::array<float, most_looked_at> values;
    const std::size_t count = std::min(row.size(), most_looked_at);
    if (count == 0) return 0;
    for (std::size_t i = 0; i < count; ++i) values[i] = value_of(row[i * row.size() / count]);
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(count / 2);
    std::nth_element(values.begin(), middle, values.begin() + static_cast<std::ptrdiff_t>(count));
    return *middle;
}

// What so much of the values, 0 … 1, do not exceed. Changes their order.
float quantile_of(std::span<float> values, double share) {
    const auto at =
        values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
    std::nth_element(values.begin(), at, values.end());
    return *at;
}

void limit_by_others(std::vector<float>& spacings) {
    if (spacings.empty()) return;
    std::vector<float> others = spacings;
    const float most = std::min(most_over_nearly_all * quantile_of(others, nearly_all),
                                most_over_half * quantile_of(others, 0.5));
    for (float& spacing : spacings) spacing = std::min(spacing, most);
}

} // namespace

std::vector<float> local_spacing(const Graph& graph, std::span<const float> positions, Workers& workers) {
    std::vector<float> fifth(graph.size()), second(graph.size()), result(graph.size());
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        const Nearest found = find_nearest(graph, positions, v);
        const auto distance = [&](std::size_t number) {
            return found.count > 0 ? found.near[std::min(number, found.count) - 1].first : 0;
        };
        fifth[v] = distance(5);
        second[v] = distance(2);
    });
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        const float around = median_of(graph.row(v), [&](Index u) { return fifth[u]; });
        const float step = median_of(graph.row(v), [&](Index u) { return second[u]; });
        result[v] = std::min({fifth[v], most_over_neighbors * around, most_over_second * step});
    });
    limit_by_others(result);
    return result;
}

std::vector<float> spacing_of_points(const PointOrder& order, const Graph& graph,
                                     std::span<const float> positions, Workers& workers) {
    const std::vector<float> of_vertices =
        local_spacing(graph, vertex_positions(order, positions, workers), workers);
    std::vector<float> spacings(order.points());
    for (std::size_t i = 0; i < spacings.size(); ++i) spacings[i] = of_vertices[order.vertex[i]];
    return spacings;
}

} // namespace knead

#include "graph/local_spacing.h"

#include "graph/nearest.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr std::size_t nearest = 5;
constexpr float most_over_neighbors = 2;
constexpr double nearly_all = 0.95; // of the vertices
constexpr float most_over_nearly_all = 2;
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

void limit_to_nearly_all(std::vector<float>& spacings) {
    if (spacings.empty()) return;
    std::vector<float> sorted = spacings;
    const auto found =
        sorted.begin() + static_cast<std::ptrdiff_t>(nearly_all * static_cast<double>(sorted.size() - 1));
    std::nth_element(sorted.begin(), found, sorted.end());
    for (float& spacing : spacings) spacing = std::min(spacing, most_over_nearly_all * *found);
}

} // namespace

std::vector<float> local_spacing(const Graph& graph, std::span<const float> positions, Workers& workers) {
    std::vector<float> alone(graph.size()), result(graph.size());
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        const Nearest found = find_nearest(graph, positions, v);
        alone[v] = found.count > 0 ? found.near[std::min(nearest, found.count) - 1].first : 0;
    });
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        const float around = median_of(graph.row(v), [&](Index u) { return alone[u]; });
        result[v] = std::min(alone[v], most_over_neighbors * around);
    });
    limit_to_nearly_all(result);
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

#include "graph/link_lengths.h"

#include "base/large_pages.h"
#include "base/types.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

constexpr double levels_a_median_link = 16;

double length_of(const Graph& graph, std::span<const float> positions, std::size_t v, std::size_t link) {
    return (point_at(positions, v) - point_at(positions, graph.neighbor[link])).norm();
}

// The median length of a link, over those of at most 4096 vertices, evenly chosen.
double median_length(const Graph& graph, std::span<const float> positions) {
    std::vector<double> lengths;
    const std::size_t stride = graph.size() / 4096 + 1;
    for (std::size_t v = 0; v < graph.size(); v += stride)
        for (std::size_t link = graph.first[v]; link < graph.first[v + 1]; ++link)
            lengths.push_back(length_of(graph, positions, v, link));
    if (lengths.empty()) return 1;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

} // namespace

std::vector<std::uint8_t> link_lengths(const Graph& graph, std::span<const float> positions,
                                       Workers& workers) {
    const double level = median_length(graph, positions) / levels_a_median_link;
    auto lengths = zeros_in_large_pages<std::uint8_t>(graph.neighbor.size(), workers);
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        for (std::size_t link = graph.first[v]; link < graph.first[v + 1]; ++link)
            lengths[link] = static_cast<std::uint8_t>(std::clamp(
                std::round(length_of(graph, positions, v, link) / level), 1.0, double{longest_link}));
    });
    return lengths;
}

} // namespace knead

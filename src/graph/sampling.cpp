#include "graph/sampling.h"

#include "graph/octree.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <limits>
#include <map>

namespace knead {

namespace {

// Vertices by label, ascending within each.
using ByLabel = std::map<Index, std::vector<Index>>;

bool touches_free(const Graph& graph, std::span<const Index> label, Index v) {
    return std::ranges::any_of(graph.row(v), [&](Index u) { return label[u] == no_index; });
}

ByLabel borders(const Graph& graph, std::span<const Index> label, const std::vector<bool>& taken) {
    ByLabel border;
    for (Index v = 0; v < label.size(); ++v)
        if (label[v] != no_index && !taken[v] && touches_free(graph, label, v)) border[label[v]].push_back(v);
    return border;
}

// Adds a sample wherever a label has none in a component that it reaches into.
void give_each_one(const VertexShape& shape, std::span<const Index> label, std::vector<bool>& taken,
                   std::vector<Index>& added) {
    std::map<std::pair<Index, Index>, std::vector<Index>> parts;
    for (Index v = 0; v < label.size(); ++v)
        if (label[v] != no_index) parts[{label[v], shape.components.component[v]}].push_back(v);
    for (const auto& [part, vertices] : parts) {
        if (std::ranges::any_of(vertices, [&](Index v) { return taken[v]; })) continue;
        const Index chosen = octree_samples(shape.code, shape.positions, vertices, 1).front();
        taken[chosen] = true;
        added.push_back(chosen);
    }
}

} // namespace

std::vector<Index> relaxed(std::vector<Index> samples, const Graph& graph,
                           std::span<const std::uint8_t> lengths, std::span<const float> positions,
                           int rounds, Workers& workers, Progress& progress) {
    for (int round = 0; round < rounds; ++round) {
        const std::vector<Index> nearest = territories(graph, lengths, samples, workers, progress);
        std::vector<Vec3d> mean(samples.size(), Vec3d::Zero());
        std::vector<double> count(samples.size(), 0);
        for (std::size_t v = 0; v < graph.size(); ++v) {
            if (nearest[v] == no_index) continue;
            mean[nearest[v]] += point_at(positions, v);
            count[nearest[v]] += 1;
        }
        for (std::size_t s = 0; s < samples.size(); ++s) mean[s] /= count[s];
        std::vector<double> smallest(samples.size(), std::numeric_limits<double>::infinity());
        for (std::size_t v = 0; v < graph.size(); ++v) {
            if (nearest[v] == no_index) continue;
            const Index s = nearest[v];
            const double squared = (point_at(positions, v) - mean[s]).squaredNorm();
            if (squared >= smallest[s]) continue;
            smallest[s] = squared;
            samples[s] = static_cast<Index>(v);
        }
    }
    return samples;
}

std::vector<Index> handle_samples(const VertexShape& shape, std::span<const Index> label,
                                  std::span<const Index> base, std::size_t budget) {
    std::vector<bool> taken(label.size(), false);
    for (const Index v : base) taken[v] = true;
    std::vector<Index> added;
    const ByLabel border = borders(shape.graph, label, taken);
    for (const auto& [handle, vertices] : border) {
        for (const Index v : octree_samples(shape.code, shape.positions, vertices, budget / border.size())) {
            taken[v] = true;
            added.push_back(v);
        }
    }
    give_each_one(shape, label, taken, added);
    return added;
}

SampleGraph sample_graph(const InfluenceRows& nearest, std::span<const Index> samples,
                         std::span<const TerritoryBorder> borders, Workers& workers) {
    std::vector<Index> links(samples.size() * sample_neighbors, no_index);
    workers.for_each(samples.size(), 1024, [&](std::size_t s) {
        std::size_t kept = 0;
        for (const Index other : nearest[samples[s]].sample)
            if (other != s && other != no_index && kept < sample_neighbors)
                links[s * sample_neighbors + kept++] = other;
    });
    std::vector<std::pair<Index, Index>> touching;
    touching.reserve(borders.size());
    for (const TerritoryBorder& border : borders) touching.emplace_back(border.a, border.b);
    SampleGraph result;
    result.graph = with_edges(symmetric_graph(links, sample_neighbors, workers), touching);
    result.contact.assign(result.graph.neighbor.size(), 0.5F);
    for (const auto& [a, b, crossing] : borders) {
        const auto contact = static_cast<float>(crossing);
        result.contact[*find_link(result.graph, a, b)] = contact;
        result.contact[*find_link(result.graph, b, a)] = contact;
    }
    return result;
}

SampleGraph sample_graph(const InfluenceRows& nearest, std::span<const Index> samples, const Graph& points,
                         Workers& workers) {
    return sample_graph(nearest, samples, territory_borders(nearest, points, workers), workers);
}

SampleGraph sample_graph_of_all(const Graph& points) {
    return {points, std::vector<float>(points.neighbor.size(), 1.0F)};
}

} // namespace knead

#include "graph/chosen_vertices.h"

#include "base/require.h"
#include "graph/bridges.h"

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t vertices_a_chunk = 4096;

// Of the vertices of a chunk, or before it. Whole numbers: sums are exact.
struct Amount {
    std::uint64_t area = 0, vertices = 0;
};

// The mean square of the lengths of a vertex's links, in fractions of a square level; at least 1 of these.
std::uint64_t area_at(const Graph& graph, std::span<const std::uint8_t> lengths, Index v) {
    constexpr std::uint64_t fractions = 16;
    const Index first = graph.first[v], end = graph.first[v + 1];
    std::uint64_t sum = 0;
    for (Index link = first; link < end; ++link) sum += std::uint64_t{lengths[link]} * lengths[link];
    return std::max<std::uint64_t>(1, fractions * sum / std::max<Index>(1, end - first));
}

// Chooses as if the areas lay one behind the other: where another `step` ends.
class Chooser {
public:
    Chooser(std::uint64_t before, double step)
        : before_(before), step_(step), steps_(std::floor(static_cast<double>(before) / step)) {}

    void pass(Index vertex, std::uint64_t area, ChosenVertices& chosen) {
        before_ += area;
        const double steps = std::floor(static_cast<double>(before_) / step_);
        if (steps > steps_) {
            chosen.vertex.push_back(vertex);
            chosen.each.push_back(std::max(1.0, step_ / static_cast<double>(area)));
        }
        steps_ = steps;
    }

private:
    std::uint64_t before_;
    double step_, steps_;
};

ChosenVertices all_but(std::span<const std::uint8_t> hanging, std::size_t vertices) {
    ChosenVertices chosen;
    chosen.vertex.reserve(vertices);
    for (Index v = 0; v < vertices; ++v)
        if (!hangs(hanging, v)) chosen.vertex.push_back(v);
    chosen.each.assign(chosen.vertex.size(), 1.0);
    return chosen;
}

} // namespace

ChosenVertices choose_by_number(std::size_t vertices, std::size_t count) {
    count = std::min(count, vertices);
    ChosenVertices chosen;
    chosen.all = count == vertices;
    chosen.vertex.reserve(count);
    for (std::size_t k = 0; k < count; ++k) chosen.vertex.push_back(static_cast<Index>(k * vertices / count));
    if (count > 0) chosen.each.assign(count, static_cast<double>(vertices) / static_cast<double>(count));
    return chosen;
}

ChosenVertices choose_by_area(const Graph& graph, std::span<const std::uint8_t> lengths,
                              std::span<const std::uint8_t> hanging, std::size_t count, Workers& workers) {
    require(lengths.size() == graph.neighbor.size(), "a length a link");
    const std::size_t vertices = graph.size();
    if (vertices <= count) return all_but(hanging, vertices);
    std::vector<Amount> before((vertices + vertices_a_chunk - 1) / vertices_a_chunk + 1);
    workers.for_chunks(vertices, vertices_a_chunk, [&](std::size_t begin, std::size_t end) {
        Amount& amount = before[begin / vertices_a_chunk + 1];
        for (auto v = static_cast<Index>(begin); v < end; ++v) {
            if (hangs(hanging, v)) continue;
            amount.area += area_at(graph, lengths, v);
            ++amount.vertices;
        }
    });
    for (std::size_t chunk = 1; chunk < before.size(); ++chunk) {
        before[chunk].area += before[chunk - 1].area;
        before[chunk].vertices += before[chunk - 1].vertices;
    }
    if (before.back().vertices <= count) return all_but(hanging, vertices);

    const double step = static_cast<double>(before.back().area) / static_cast<double>(count);
    std::vector<ChosenVertices> parts(count > 0 ? before.size() - 1 : 0);
    workers.for_each(parts.size(), 1, [&](std::size_t chunk) {
        Chooser chooser(before[chunk].area, step);
        const std::size_t end = std::min((chunk + 1) * vertices_a_chunk, vertices);
        for (auto v = static_cast<Index>(chunk * vertices_a_chunk); v < end; ++v)
            if (!hangs(hanging, v)) chooser.pass(v, area_at(graph, lengths, v), parts[chunk]);
    });
    ChosenVertices chosen;
    chosen.all = false;
    for (const ChosenVertices& part : parts) {
        chosen.vertex.insert(chosen.vertex.end(), part.vertex.begin(), part.vertex.end());
        chosen.each.insert(chosen.each.end(), part.each.begin(), part.each.end());
    }
    return chosen;
}

} // namespace knead

#include "graph/chosen_vertices.h"

#include "base/require.h"
#include "graph/bridges.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

namespace knead {

namespace {

constexpr std::size_t vertices_a_chunk = 4096;

// Of some vertices. Whole numbers: sums are exact.
struct Amount {
    std::uint64_t area = 0, vertices = 0;

    void operator+=(const Amount& other) {
        area += other.area;
        vertices += other.vertices;
    }
};

// By how many bits an area has. (A mean square of lengths of 8 bits, and its fractions, has 20 at most.)
constexpr std::size_t octaves = 21;
using ByOctave = std::array<Amount, octaves>;

// The mean square of the lengths of a vertex's links, in fractions of a square level; at least 1 of these.
std::uint64_t area_at(const Graph& graph, std::span<const std::uint8_t> lengths, Index v) {
    constexpr std::uint64_t fractions = 16;
    const Index first = graph.first[v], end = graph.first[v + 1];
    std::uint64_t sum = 0;
    for (Index link = first; link < end; ++link) sum += std::uint64_t{lengths[link]} * lengths[link];
    return std::max<std::uint64_t>(1, fractions * sum / std::max<Index>(1, end - first));
}

// The area that one of `count` stands for, those left aside that have more of it anyway and stand for
// themselves.
double step_for(const ByOctave& all, Amount left, std::size_t count) {
    auto chosen = static_cast<double>(count);
    const auto step = [&] { return static_cast<double>(left.area) / chosen; };
    for (std::size_t octave = octaves - 1; octave > 0; --octave) {
        const double least = std::ldexp(1.0, static_cast<int>(octave) - 1);
        const Amount& large = all[octave];
        if (least < step() || static_cast<double>(large.vertices) >= chosen) break;
        chosen -= static_cast<double>(large.vertices);
        left.area -= large.area;
    }
    return step();
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

// Of all vertices, and the area before each chunk of them.
struct Counted {
    ByOctave by_octave{};
    Amount all;
    std::vector<std::uint64_t> before; // the last entry: of all
};

Counted count_areas(const Graph& graph, std::span<const std::uint8_t> lengths,
                    std::span<const std::uint8_t> hanging, Workers& workers) {
    const std::size_t chunks = (graph.size() + vertices_a_chunk - 1) / vertices_a_chunk;
    std::vector<ByOctave> of_chunk(chunks);
    workers.for_chunks(graph.size(), vertices_a_chunk, [&](std::size_t begin, std::size_t end) {
        ByOctave& amounts = of_chunk[begin / vertices_a_chunk];
        for (auto v = static_cast<Index>(begin); v < end; ++v) {
            if (hangs(hanging, v)) continue;
            const std::uint64_t area = area_at(graph, lengths, v);
            amounts[static_cast<std::size_t>(std::bit_width(area))] += {area, 1};
        }
    });
    Counted counted;
    for (const ByOctave& amounts : of_chunk) {
        counted.before.push_back(counted.all.area);
        for (std::size_t octave = 0; octave < octaves; ++octave) {
            counted.by_octave[octave] += amounts[octave];
            counted.all += amounts[octave];
        }
    }
    counted.before.push_back(counted.all.area);
    return counted;
}

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
    const Counted counted = count_areas(graph, lengths, hanging, workers);
    if (counted.all.vertices <= count) return all_but(hanging, vertices);

    const double step = step_for(counted.by_octave, counted.all, count);
    std::vector<ChosenVertices> parts(count > 0 ? counted.before.size() - 1 : 0);
    workers.for_each(parts.size(), 1, [&](std::size_t chunk) {
        Chooser chooser(counted.before[chunk], step);
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

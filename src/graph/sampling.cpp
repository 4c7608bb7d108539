#include "graph/sampling.h"

#include "base/gathered.h"
#include "base/require.h"
#include "graph/octree.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <map>
#include <set>

namespace knead {

namespace {

constexpr std::size_t grain = 1 << 14;

// So many samples a border gets for each territory that it runs through.
constexpr std::size_t samples_a_territory = 2;

// The label of a vertex and its component.
using Part = std::pair<Index, Index>;

bool touches_free(const Graph& graph, std::span<const Index> label, Index v) {
    return std::ranges::any_of(graph.row(v), [&](Index u) { return label[u] == no_index; });
}

struct Labelled {
    std::vector<BorderVertex> borders; // ascending by (label, vertex)
    std::set<Part> parts;              // that labels reach into
};

Labelled find_labelled(const VertexShape& shape, std::span<const Index> label, Workers& workers) {
    Gathered<BorderVertex> borders;
    Gathered<Part> parts;
    workers.for_chunks(label.size(), grain, [&](std::size_t begin, std::size_t end) {
        Gathered<BorderVertex>::Block borders_here(borders);
        std::set<Part> parts_here;
        Part last{no_index, no_index};
        for (auto v = static_cast<Index>(begin); v < end; ++v) {
            if (label[v] == no_index) continue;
            const Part part{label[v], shape.components.component[v]};
            if (part != last) parts_here.insert(part);
            last = part;
            if (touches_free(shape.graph, label, v)) borders_here.push({label[v], v});
        }
        Gathered<Part>::Block found(parts);
        for (const Part& part : parts_here) found.push(part);
    });
    Labelled result;
    borders.take([&](const BorderVertex& each) { result.borders.push_back(each); });
    std::ranges::sort(result.borders, {},
                      [](const BorderVertex& each) { return std::pair(each.label, each.vertex); });
    parts.take([&](const Part& part) { result.parts.insert(part); });
    return result;
}

// How many territories of base samples these vertices belong to; what no base sample reaches counts as one.
std::size_t territories_of(std::span<const Index> vertices, const TerritoryRows& nearest) {
    std::vector<Index> samples;
    samples.reserve(vertices.size());
    for (const Index v : vertices) samples.push_back(nearest[v].sample[0]);
    std::ranges::sort(samples);
    return static_cast<std::size_t>(std::unique(samples.begin(), samples.end()) - samples.begin());
}

// One to each border that got none, from those that got most, as long as these have some to spare.
void leave_none_out(std::map<Index, std::size_t>& share) {
    for (auto& [label, count] : share) {
        if (count > 0) continue;
        auto& [richest, most] =
            *std::ranges::max_element(share, {}, [](const auto& each) { return each.second; });
        if (most < 2) return;
        --most;
        ++count;
    }
}

// How many samples the border of each label gets.
std::map<Index, std::size_t> shares(const std::map<Index, std::vector<Index>>& borders,
                                    const TerritoryRows& nearest, std::size_t budget) {
    std::map<Index, std::size_t> share;
    std::size_t wanted = 0;
    for (const auto& [label, vertices] : borders)
        wanted += share[label] =
            std::min(vertices.size(), samples_a_territory * territories_of(vertices, nearest));
    if (wanted <= budget) return share;
    std::size_t before = 0; // of what is wanted
    for (auto& [label, count] : share) {
        const std::size_t given = before * budget / wanted;
        before += count;
        count = before * budget / wanted - given; // the budget in all, to the last sample
    }
    leave_none_out(share);
    return share;
}

// One vertex of each of these parts.
std::vector<Index> one_of_each(const std::set<Part>& parts, const VertexShape& shape,
                               std::span<const Index> label) {
    std::map<Part, std::vector<Index>> vertices; // ascending
    if (!parts.empty())
        for (Index v = 0; v < label.size(); ++v) {
            const Part part{label[v], shape.components.component[v]};
            if (label[v] != no_index && parts.contains(part)) vertices[part].push_back(v);
        }
    std::vector<Index> chosen;
    chosen.reserve(vertices.size());
    for (const auto& [part, among] : vertices)
        chosen.push_back(octree_samples(shape.code, shape.positions, among, 1).front());
    return chosen;
}

// From a sample to another one.
struct Way {
    Index from, to, levels;
};

// All that lead to or from samples that were added to the flood, ascending: to the others of their rows,
// which hold none of them, and across the borders of their territories.
std::vector<Way> ways_of_added(std::span<const WideRow> nearest, std::span<const TerritoryBorder> borders) {
    std::vector<Way> ways;
    const auto add = [&](Index one, Index other, Index levels) {
        ways.push_back({one, other, levels});
        ways.push_back({other, one, levels});
    };
    for (Index s = 0; s < nearest.size(); ++s) {
        const WideRow& row = nearest[s];
        if (row.sample[0] == s) continue;
        for (std::size_t k = 0; k < row.count(); ++k) add(s, row.sample.at(k), row.distance.at(k));
    }
    for (const TerritoryBorder& border : borders)
        if (border.way != no_index) add(border.a, border.b, border.way);
    std::ranges::sort(ways, {}, &Way::from);
    return ways;
}

// Those of them that begin at a sample.
std::span<const Way> ways_from(std::span<const Way> ways, Index sample) {
    const auto begin = std::ranges::lower_bound(ways, sample, {}, &Way::from);
    return {begin, std::ranges::upper_bound(ways, sample, {}, &Way::from)};
}

// The nearest of the other samples of a row, and of those that these ways lead to.
std::vector<Index> nearest_others(const WideRow& row, Index sample, std::span<const Way> ways) {
    std::vector<std::pair<Index, Index>> reached; // how far, and which
    for (std::size_t k = 0; k < row.count(); ++k) reached.emplace_back(row.distance.at(k), row.sample.at(k));
    for (const Way& way : ways_from(ways, sample)) reached.emplace_back(way.levels, way.to);
    std::ranges::sort(reached);
    std::vector<Index> others;
    for (const auto& [levels, other] : reached) {
        if (others.size() == sample_neighbors) break;
        if (other != sample && std::ranges::find(others, other) == others.end()) others.push_back(other);
    }
    return others;
}

} // namespace

HandleSamples handle_samples(const VertexShape& shape, std::span<const Index> label,
                             std::span<const Index> base, const TerritoryRows& nearest, std::size_t budget,
                             Workers& workers) {
    require(nearest.size() == label.size(), "a row and a label a vertex");
    const auto part_of = [&](Index v) { return Part{label[v], shape.components.component[v]}; };
    auto [borders, parts] = find_labelled(shape, label, workers);
    std::vector<bool> taken(label.size(), false);
    for (const Index v : base) {
        taken[v] = true;
        parts.erase(part_of(v));
    }
    std::map<Index, std::vector<Index>> border; // by label, ascending within each
    for (const auto& [handle, v] : borders)
        if (!taken[v]) border[handle].push_back(v);
    const std::map<Index, std::size_t> share = shares(border, nearest, budget);
    std::vector<Index> added;
    for (const auto& [handle, vertices] : border)
        for (const Index v : octree_samples(shape.code, shape.positions, vertices, share.at(handle))) {
            added.push_back(v);
            parts.erase(part_of(v));
        }
    for (const Index v : one_of_each(parts, shape, label)) added.push_back(v);
    return {std::move(added), std::move(borders)};
}

SampleGraph sample_graph(std::span<const WideRow> nearest, std::span<const TerritoryBorder> borders,
                         Workers& workers) {
    const std::vector<Way> ways = ways_of_added(nearest, borders);
    std::vector<Index> links(nearest.size() * sample_neighbors, no_index);
    workers.for_each(nearest.size(), 1024, [&](std::size_t s) {
        const std::vector<Index> others = nearest_others(nearest[s], static_cast<Index>(s), ways);
        std::ranges::copy(others, links.begin() + static_cast<std::ptrdiff_t>(s * sample_neighbors));
    });
    std::vector<std::pair<Index, Index>> touching;
    touching.reserve(borders.size());
    for (const TerritoryBorder& border : borders) touching.emplace_back(border.a, border.b);
    SampleGraph result;
    result.graph = with_edges(symmetric_graph(links, sample_neighbors, workers), touching, workers);
    result.contact.assign(result.graph.neighbor.size(), 0.5F);
    for (const auto& [a, b, crossing, way] : borders) {
        const auto contact = static_cast<float>(crossing);
        result.contact[*find_link(result.graph, a, b)] = contact;
        result.contact[*find_link(result.graph, b, a)] = contact;
    }
    return result;
}

SampleGraph sample_graph(const InfluenceRows& nearest, std::span<const Index> samples, const Graph& points,
                         Workers& workers) {
    return sample_graph(rows_at(nearest, samples),
                        territory_borders(territory_rows(nearest, workers), points, workers), workers);
}

SampleGraph sample_graph_of_all(const Graph& points) {
    return {points, std::vector<float>(points.neighbor.size(), 1.0F)};
}

} // namespace knead

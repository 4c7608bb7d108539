#include "graph/sampling.h"

#include "base/require.h"
#include "graph/octree.h"
#include "graph/scrambled.h"
#include "graph/symmetric_graph.h"

#include <algorithm>
#include <iterator>
#include <map>
#include <set>

namespace knead {

namespace {

// So many samples a border gets for each territory that it runs through.
constexpr std::size_t samples_a_territory = 2;

struct Held {
    std::vector<BorderVertex> borders; // ascending by (label, vertex)
    std::set<HeldPart> parts;          // each of which has to own a sample
};

// Of a label that has no border at all, one part will do.
Held all_of(std::span<const HeldBlock> blocks, const ComponentNumbers& component,
            const std::vector<bool>& everywhere) {
    Held all;
    for (const HeldBlock& block : blocks)
        all.borders.insert(all.borders.end(), block.borders.begin(), block.borders.end());
    std::ranges::stable_sort(all.borders, {}, &BorderVertex::label);
    std::set<Index> has_one;
    const auto add = [&](const HeldPart& part) {
        all.parts.insert(part);
        has_one.insert(part.label);
    };
    for (const BorderVertex& border : all.borders) add({border.label, component[border.vertex]});
    for (const HeldBlock& block : blocks)
        for (const HeldPart& part : block.parts)
            if (is_set(everywhere, part.label) || !has_one.contains(part.label)) add(part);
    return all;
}

// Of the border of a part, what may become samples.
struct Border {
    std::vector<Index> vertices;    // ascending
    std::vector<Index> territories; // the base samples that are nearest to them, no_index where none is near
};

// Those of the parts, without vertices that are taken.
std::map<HeldPart, Border> open_borders(std::span<const BorderVertex> borders,
                                        const ComponentNumbers& component, const std::vector<bool>& taken,
                                        const ChangingTerritories& nearest) {
    std::vector<BorderVertex> open;
    std::ranges::copy_if(borders, std::back_inserter(open),
                         [&](const BorderVertex& each) { return !taken[each.vertex]; });
    std::vector<Index> vertices(open.size());
    std::ranges::transform(open, vertices.begin(), &BorderVertex::vertex);
    const std::vector<Index> samples = nearest_of_base(nearest, vertices);
    std::map<HeldPart, Border> result;
    for (std::size_t i = 0; i < open.size(); ++i) {
        Border& border = result[{open[i].label, component[open[i].vertex]}];
        border.vertices.push_back(open[i].vertex);
        border.territories.push_back(samples[i]);
    }
    return result;
}

// How many samples a border needs.
std::size_t needed_by(const Border& border) {
    std::vector<Index> territories = border.territories;
    std::ranges::sort(territories);
    const auto count = std::unique(territories.begin(), territories.end()) - territories.begin();
    return std::min(border.vertices.size(), samples_a_territory * static_cast<std::size_t>(count));
}

// How many samples each part gets.
using Shares = std::map<HeldPart, std::size_t>;

// One to each border that got none, from those that got most, as long as these have some to spare.
void leave_none_out(Shares& share) {
    for (auto& [part, count] : share) {
        if (count > 0) continue;
        auto& [richest, most] =
            *std::ranges::max_element(share, {}, [](const auto& each) { return each.second; });
        if (most < 2) return;
        --most;
        ++count;
    }
}

// `parts`: those that own none yet, and get one each whatever the budget is.
Shares shares(const std::map<HeldPart, Border>& borders, const std::set<HeldPart>& parts,
              std::size_t budget) {
    Shares share;
    for (const HeldPart& part : parts) share[part] = 1;
    const std::size_t left = budget - std::min(budget, parts.size());
    Shares more;
    std::size_t wanted = 0;
    for (const auto& [part, border] : borders) { // each needs one at least
        const std::size_t has = parts.contains(part) ? 1 : 0;
        wanted += more[part] = needed_by(border) - has;
    }
    std::size_t before = 0; // of what is wanted
    for (const auto& [part, count] : more) {
        if (wanted <= left) {
            share[part] += count;
            continue;
        }
        const std::size_t given = before * left / wanted;
        before += count;
        share[part] += before * left / wanted - given; // the budget in all, to the last sample
    }
    leave_none_out(share);
    return share;
}

// Those that are no outliers, if there are any.
std::vector<Index> on_surface(const VertexShape& shape, const std::vector<Index>& vertices) {
    if (shape.hanging.empty()) return vertices;
    std::vector<Index> kept;
    std::ranges::copy_if(vertices, std::back_inserter(kept), [&](Index v) { return !shape.hanging[v]; });
    return kept.empty() ? vertices : kept;
}

// One vertex of each of these parts.
std::vector<Index> one_of_each(const std::set<HeldPart>& parts, const VertexShape& shape,
                               const VertexLabels& labels) {
    std::map<HeldPart, std::vector<Index>> vertices; // ascending
    if (!parts.empty())
        for_each_held(labels, 0, labels.label.size(), [&](Index v) {
            const HeldPart part{labels.label[v], shape.components.component[v]};
            if (parts.contains(part)) vertices[part].push_back(v);
        });
    std::vector<Index> chosen;
    chosen.reserve(vertices.size());
    for (const auto& [part, among] : vertices)
        chosen.push_back(octree_samples(shape.cube, shape.positions, on_surface(shape, among), 1).front());
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

// Brings added samples into the order of their numbers: handle by handle, and each handle's by themselves, so
// that they stay as they are while other handles come and go.
void put_in_order(std::vector<Index>& added, const VertexLabels& labels) {
    const auto label_of = [&](Index v) { return labels.label[v]; };
    std::ranges::sort(added, {}, label_of);
    for (std::span<Index> rest(added); !rest.empty();) {
        const auto end = std::ranges::upper_bound(rest, label_of(rest.front()), {}, label_of);
        const auto own = static_cast<std::size_t>(end - rest.begin());
        shuffle_in_runs(rest.first(own));
        rest = rest.subspan(own);
    }
}

} // namespace

HandleSamples handle_samples(const VertexShape& shape, const VertexLabels& labels,
                             std::span<const HeldBlock> held, std::span<const Index> base,
                             const ChangingTerritories& nearest, const std::vector<bool>& everywhere,
                             std::size_t budget) {
    require(nearest.nearest.size() == labels.label.size(), "a row and a label a vertex");
    const ComponentNumbers& component = shape.components.component;
    const auto part_of = [&](Index v) { return HeldPart{labels.label[v], component[v]}; };
    auto [borders, parts] = all_of(held, component, everywhere);
    std::vector<bool> taken(labels.label.size(), false);
    for (const Index v : base) {
        taken[v] = true;
        parts.erase(part_of(v));
    }
    const std::map<HeldPart, Border> open = open_borders(borders, component, taken, nearest);
    const Shares share = shares(open, parts, budget);
    std::vector<Index> added;
    for (const auto& [part, border] : open)
        for (const Index v : octree_samples(shape.cube, shape.positions, on_surface(shape, border.vertices),
                                            share.at(part))) {
            added.push_back(v);
            parts.erase(part);
        }
    for (const Index v : one_of_each(parts, shape, labels)) added.push_back(v);
    put_in_order(added, labels);
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

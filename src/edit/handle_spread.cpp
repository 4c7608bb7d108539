#include "edit/handle_spread.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <utility>
#include <vector>

namespace knead {

namespace {

using Pair = std::pair<Index, Index>; // of labels, the lower one first

// Which samples a handle reaches first, and in how many links.
struct Reached {
    std::vector<Index> handle; // of each sample; no_index: none does
    std::vector<Index> links;
};

Reached reach(const HandleLabels& labels, std::span<const Index> samples, const Graph& between) {
    Reached reached{std::vector<Index>(samples.size(), no_index), std::vector<Index>(samples.size(), 0)};
    std::deque<Index> front;
    for (Index s = 0; s < samples.size(); ++s) {
        reached.handle[s] = labels.vertex[samples[s]];
        if (reached.handle[s] != no_index) front.push_back(s);
    }
    for (; !front.empty(); front.pop_front()) {
        const Index from = front.front();
        for (const Index to : between.row(from)) {
            if (reached.handle[to] != no_index) continue;
            reached.handle[to] = reached.handle[from];
            reached.links[to] = reached.links[from] + 1;
            front.push_back(to);
        }
    }
    return reached;
}

// Handles of which points are neighbours.
std::set<Pair> touching(const HandleLabels& labels, const Graph& points) {
    std::set<Pair> pairs;
    for (Index v = 0; v < points.size(); ++v) {
        const Index one = labels.vertex[v];
        if (one == no_index) continue;
        for (const Index w : points.row(v))
            if (labels.vertex[w] != no_index && labels.vertex[w] > one) pairs.emplace(one, labels.vertex[w]);
    }
    return pairs;
}

double closest_of(const HandleLabels& labels, const Graph& points, std::span<const Index> samples,
                  const Graph& between) {
    const Reached reached = reach(labels, samples, between);
    const std::set<Pair> not_apart = touching(labels, points);
    double closest = std::sqrt(static_cast<double>(samples.size()));
    for (Index s = 0; s < samples.size(); ++s)
        for (const Index t : between.row(s)) {
            const Pair pair{reached.handle[s], reached.handle[t]};
            if (pair.second == no_index || pair.first >= pair.second || not_apart.contains(pair)) continue;
            closest = std::min(closest, static_cast<double>(reached.links[s]) + reached.links[t] + 1);
        }
    return closest;
}

} // namespace

HandleSpread spread_of(const HandleLabels& labels, const Graph& points, std::span<const Index> samples,
                       const Graph& between) {
    HandleSpread spread;
    std::vector<std::size_t> held(labels.outside, 0);
    for (const Index label : labels.vertex)
        if (label < labels.outside) ++held[label];
    std::erase(held, std::size_t{0});
    if (held.empty() || samples.empty()) return spread;
    spread.count = held.size();
    spread.smallest = static_cast<double>(std::ranges::min(held)) / static_cast<double>(labels.vertex.size());
    spread.closest =
        closest_of(labels, points, samples, between) / std::sqrt(static_cast<double>(samples.size()));
    return spread;
}

} // namespace knead

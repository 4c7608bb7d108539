#include "graph/dust.h"

#include "graph/disjoint_sets.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

namespace knead {

namespace {

// A link that would tie two pieces.
struct Tie {
    double squared; // its length
    Index from, to;
};

// Outliers that are linked through each other, and the other vertices that they are linked to, by pieces.
struct Cloud {
    std::vector<Index> outliers, beside;
};

// Calls visit(cloud) for all of them.
template<typename Visit>
void for_clouds(const Graph& graph, const Components& pieces, std::span<const std::uint8_t> outlier,
                Visit&& visit) {
    std::vector<std::uint8_t> is_met(graph.size(), 0);
    Cloud cloud;
    for (Index seed = 0; seed < graph.size(); ++seed) {
        if (!outlier[seed] || is_met[seed]) continue;
        is_met[seed] = 1;
        cloud.outliers.assign(1, seed);
        cloud.beside.clear();
        for (std::size_t next = 0; next < cloud.outliers.size(); ++next)
            for (const Index u : graph.row(cloud.outliers[next])) {
                if (!outlier[u])
                    cloud.beside.push_back(u);
                else if (!is_met[u])
                    cloud.outliers.push_back(u), is_met[u] = 1;
            }
        std::ranges::sort(cloud.beside, {}, [&](Index v) { return std::pair(pieces.component[v], v); });
        cloud.beside.erase(std::unique(cloud.beside.begin(), cloud.beside.end()), cloud.beside.end());
        visit(cloud);
    }
}

// The shortest between two lists of vertices; of long lists, between some of them.
Tie shortest_between(std::span<const Index> some, std::span<const Index> others,
                     std::span<const float> positions) {
    constexpr std::size_t most_pairs = 1 << 22;
    const std::size_t step = 1 + some.size() * others.size() / most_pairs;
    Tie shortest{std::numeric_limits<double>::infinity(), some.front(), others.front()};
    for (const Index v : some)
        for (std::size_t i = 0; i < others.size(); i += step) {
            const double squared = (point_at(positions, v) - point_at(positions, others[i])).squaredNorm();
            if (squared < shortest.squared) shortest = {squared, v, others[i]};
        }
    return shortest;
}

// One from the largest piece beside a cloud to each of the others.
void find_ties(const Cloud& cloud, const Components& pieces, std::span<const float> positions,
               std::vector<Tie>& ties) {
    std::vector<std::span<const Index>> parts;
    for (auto begin = cloud.beside.begin(); begin != cloud.beside.end();) {
        const auto end = std::find_if(begin, cloud.beside.end(), [&](Index v) {
            return pieces.component[v] != pieces.component[*begin];
        });
        parts.emplace_back(begin, end);
        begin = end;
    }
    const auto largest = std::ranges::max_element(
        parts, {}, [&](const auto& part) { return pieces.size[pieces.component[part.front()]]; });
    for (auto part = parts.begin(); part != parts.end(); ++part)
        if (part != largest) ties.push_back(shortest_between(*part, *largest, positions));
}

// Those that join what is still apart (Kruskal).
std::vector<std::pair<Index, Index>> needed(std::vector<Tie> ties, const Components& pieces) {
    std::ranges::sort(ties, {}, [](const Tie& tie) { return std::tuple(tie.squared, tie.from, tie.to); });
    std::vector<Index> root(ties.empty() ? 0 : pieces.size.size());
    std::iota(root.begin(), root.end(), Index{0});
    std::vector<std::pair<Index, Index>> links;
    for (const Tie& tie : ties)
        if (join(root, pieces.component[tie.from], pieces.component[tie.to]))
            links.emplace_back(tie.from, tie.to);
    return links;
}

} // namespace

Dust gather_dust(const Graph& graph, const Components& pieces, std::span<const std::uint8_t> outlier,
                 std::span<const float> positions) {
    Dust dust;
    dust.hanging.assign(outlier.begin(), outlier.end());
    std::vector<Tie> ties;
    for_clouds(graph, pieces, outlier, [&](const Cloud& cloud) {
        if (cloud.beside.empty())
            for (const Index v : cloud.outliers) dust.hanging[v] = 0;
        else
            find_ties(cloud, pieces, positions, ties);
    });
    dust.ties = needed(std::move(ties), pieces);
    return dust;
}

} // namespace knead

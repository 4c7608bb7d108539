#include "graph/edge_weights.h"

#include "base/require.h"

#include <algorithm>

namespace knead {

namespace {

constexpr int updates = 4;

// How far a weight may leave its vertex's mean: a link that stands alone in its direction would take all.
constexpr double largest_weight = 8;

// Brings the mean to 1.
void normalize(std::span<double> weight) {
    double sum = 0;
    for (const double w : weight) sum += w;
    for (double& w : weight) w *= static_cast<double>(weight.size()) / sum;
}

struct Star {
    std::span<const Index> row;
    std::span<const float> contact;
    Vec3d center;
    std::span<const Vec3d> position;

    Vec3d edge(std::size_t k) const { return position[row[k]] - center; }
};

void start_weights(const Star& star, std::span<double> weight) {
    double longest = 0;
    for (std::size_t k = 0; k < weight.size(); ++k) longest = std::max(longest, star.edge(k).norm());
    // Samples may come to lie on each other in the course of edits; their link counts as a short one.
    const double shortest = longest > 0 ? 1e-3 * longest : 1;
    for (std::size_t k = 0; k < weight.size(); ++k)
        weight[k] = static_cast<double>(star.contact[k]) / std::max(star.edge(k).norm(), shortest);
    normalize(weight);
}

// One multiplicative update of a vertex's weights.
void update_weights(const Star& star, std::span<double> weight) {
    Mat3d spread = Mat3d::Zero();
    for (std::size_t k = 0; k < weight.size(); ++k)
        spread.noalias() += (weight[k] * star.edge(k)) * star.edge(k).transpose();
    const auto along = [&](std::size_t k) {
        const Vec3d edge = star.edge(k);
        const double squared = edge.squaredNorm();
        return squared > 0 ? edge.dot(spread * edge) / squared : 0;
    };
    double mean = 0;
    for (std::size_t k = 0; k < weight.size(); ++k) mean += along(k) / static_cast<double>(weight.size());
    for (std::size_t k = 0; k < weight.size(); ++k) {
        const double here = along(k);
        if (here > 0) weight[k] *= mean / here;
    }
    normalize(weight);
    for (double& w : weight) w = std::clamp(w, 1 / largest_weight, largest_weight);
}

} // namespace

std::vector<double> isotropic_weights(const Graph& graph, std::span<const Vec3d> position,
                                      std::span<const float> contact, Workers& workers) {
    require(contact.size() == graph.neighbor.size(), "a contact a link");
    std::vector<double> one_way(graph.neighbor.size());
    workers.for_each(graph.size(), 256, [&](std::size_t v) {
        const std::size_t first = graph.first[v];
        const Star star{graph.row(v), contact.subspan(first, graph.row(v).size()), position[v], position};
        const std::span<double> weight(one_way.data() + first, star.row.size());
        if (weight.empty()) return;
        start_weights(star, weight);
        for (int update = 0; update < updates; ++update) update_weights(star, weight);
    });
    std::vector<double> weight(graph.neighbor.size());
    workers.for_each(graph.size(), 1024, [&](std::size_t v) {
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link)
            weight[link] = 0.5 * (one_way[link] +
                                  one_way[*find_link(graph, graph.neighbor[link], static_cast<Index>(v))]);
    });
    return weight;
}

} // namespace knead

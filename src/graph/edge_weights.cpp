#include "graph/edge_weights.h"

#include "base/require.h"

#include <Eigen/Eigenvalues>

#include <algorithm>

namespace knead {

namespace {

constexpr int updates = 4;

constexpr int balancing_rounds = 3;

// So much below the bound for borders a vertex begins to be taken for one on a border.
constexpr double border_fades = 0.2;

// A vertex balances along a direction that holds as much of the spread as this, compared with the widest one;
// across a surface Σ w e is its curvature.
constexpr double along_surface = 0.15;

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

// What follows every update: the mean is 1 and no weight runs away.
void finish_update(std::span<double> weight) {
    normalize(weight);
    for (double& w : weight) w = std::clamp(w, 1 / largest_weight, largest_weight);
}

Mat3d spread_of(const Star& star, std::span<const double> weight) {
    Mat3d spread = Mat3d::Zero();
    for (std::size_t k = 0; k < weight.size(); ++k)
        spread.noalias() += (weight[k] * star.edge(k)) * star.edge(k).transpose();
    return spread;
}

// One update of a vertex's weights towards pulling as much along each direction.
void even_out(const Star& star, std::span<double> weight) {
    const Mat3d spread = spread_of(star, weight);
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
    finish_update(weight);
}

// One update towards pulls that cancel.
void balance(const Star& star, double border, std::span<double> weight) {
    Vec3d pull = Vec3d::Zero();
    double effort = 0;
    for (std::size_t k = 0; k < weight.size(); ++k) {
        const Vec3d edge = star.edge(k);
        pull += weight[k] * edge;
        effort += weight[k] * edge.norm();
    }
    Eigen::SelfAdjointEigenSolver<Mat3d> axes;
    axes.computeDirect(spread_of(star, weight));
    Vec3d uneven = Vec3d::Zero();  // Σ w e along the surface
    Vec3d counter = Vec3d::Zero(); // C⁺ of it
    for (int k = 0; k < 3; ++k) {
        const double spread = axes.eigenvalues()[k];
        if (!(spread > along_surface * axes.eigenvalues()[2])) continue;
        const Vec3d axis = axes.eigenvectors().col(k);
        uneven += axis.dot(pull) * axis;
        counter += axis.dot(pull) / spread * axis;
    }
    const double share = effort > 0 ? uneven.norm() / effort : 1;
    const double inside = std::clamp((border - share) / border_fades, 0.0, 1.0);
    for (std::size_t k = 0; k < weight.size(); ++k)
        weight[k] *= std::clamp(1 - inside * counter.dot(star.edge(k)), 0.5, 1.5);
    finish_update(weight);
}

} // namespace

std::vector<double> isotropic_weights(const Graph& graph, std::span<const Vec3d> position,
                                      std::span<const float> contact, double border, Workers& workers) {
    require(contact.size() == graph.neighbor.size(), "a contact a link");
    std::vector<double> one_way(graph.neighbor.size());
    std::vector<double> weight;
    const auto for_stars = [&](auto&& update) {
        workers.for_each(graph.size(), 256, [&](std::size_t v) {
            const std::size_t first = graph.first[v];
            const Star star{graph.row(v), contact.subspan(first, graph.row(v).size()), position[v], position};
            if (!star.row.empty()) update(star, std::span<double>(one_way.data() + first, star.row.size()));
        });
        weight.resize(one_way.size());
        workers.for_each(graph.size(), 1024, [&](std::size_t v) {
            for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) {
                const Index back = *find_link(graph, graph.neighbor[link], static_cast<Index>(v));
                weight[link] = 0.5 * (one_way[link] + one_way[back]);
            }
        });
    };
    for_stars([](const Star& star, std::span<double> own) {
        start_weights(star, own);
        for (int update = 0; update < updates; ++update) even_out(star, own);
    });
    for (int round = 0; round < balancing_rounds; ++round) {
        one_way = weight;
        for_stars([border](const Star& star, std::span<double> own) {
            even_out(star, own);
            balance(star, border, own);
        });
    }
    return weight;
}

} // namespace knead

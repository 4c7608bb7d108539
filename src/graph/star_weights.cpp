#include "graph/star_weights.h"

#include <algorithm>
#include <numbers>

namespace knead {

namespace {

// No weight is less, nor than this share of its vertex's mean where links are very many: a link that stands
// alone in its direction would take all of the others.
constexpr double least_weight = 0.125, least_share = 0.5;

// Of a vertex with links all around it.
constexpr double sum_inside = 6;

// Brings the sum to what it is to be.
void normalize(std::span<double> weight, double wanted) {
    double sum = 0;
    for (const double w : weight) sum += w;
    for (double& w : weight) w *= wanted / sum;
}

Symmetric square_of(const Vec3d& e) {
    Symmetric square;
    square << e.x() * e.x(), e.y() * e.y(), e.z() * e.z(), e.x() * e.y(), e.x() * e.z(), e.y() * e.z();
    return square;
}

} // namespace

Spoke spoke_along(const Vec3d& edge, double contact) {
    return {edge, edge.norm(), square_of(edge), contact};
}

Pull pull_of(std::span<const Spoke> star, std::span<const double> weight) {
    Pull pull;
    for (std::size_t k = 0; k < star.size(); ++k) {
        pull.sum += weight[k] * star[k].edge;
        pull.effort += weight[k] * star[k].length;
    }
    return pull;
}

double share_of_directions(const Pull& pull) {
    return pull.effort > 0 ? 1 - std::numbers::pi / 4 * (pull.sum.norm() / pull.effort) : 1;
}

Symmetric spread_of(std::span<const Spoke> star, std::span<const double> weight) {
    Symmetric spread = Symmetric::Zero();
    for (std::size_t k = 0; k < star.size(); ++k) spread += weight[k] * star[k].square;
    return spread;
}

double area_of(std::span<const Spoke> star, std::span<const double> weight) {
    double sum = 0;
    for (std::size_t k = 0; k < star.size(); ++k) sum += weight[k] * star[k].length * star[k].length;
    return sum;
}

double start_weights(std::span<const Spoke> star, std::span<double> weight) {
    double longest = 0;
    for (const Spoke& spoke : star) longest = std::max(longest, spoke.length);
    // Samples may come to lie on each other in the course of edits; their link counts as a short one.
    const double shortest = longest > 0 ? 1e-3 * longest : 1;
    for (std::size_t k = 0; k < star.size(); ++k)
        weight[k] = star[k].contact / std::max(star[k].length, shortest);
    const double sum = sum_inside * share_of_directions(pull_of(star, weight));
    normalize(weight, sum);
    return sum;
}

void even_out(std::span<Spoke> star, double sum, std::span<double> weight) {
    Symmetric spread = spread_of(star, weight);
    spread.tail<3>() *= 2; // so that its product with e eᵀ is eᵀ C e
    double mean = 0;
    for (Spoke& spoke : star) {
        spoke.along = spoke.length > 0 ? spread.dot(spoke.square) / (spoke.length * spoke.length) : 0;
        mean += spoke.along / static_cast<double>(star.size());
    }
    for (std::size_t k = 0; k < star.size(); ++k)
        if (star[k].along > 0) weight[k] *= mean / star[k].along;
    finish_update(weight, sum);
}

void finish_update(std::span<double> weight, double sum) {
    normalize(weight, sum);
    const double least = std::min(least_weight, least_share * sum / static_cast<double>(weight.size()));
    for (double& w : weight) w = std::max(w, least);
}

} // namespace knead

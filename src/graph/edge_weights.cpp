#include "graph/edge_weights.h"

#include "base/require.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <numbers>

namespace knead {

namespace {

constexpr int updates = 4;

constexpr int balancing_rounds = 3;

// So much below the bound for borders a vertex begins to be taken for one on a border.
constexpr double border_fades = 0.2;

// A vertex balances along a direction that holds as much of the spread as this, compared with the widest one;
// across a surface Σ w e is its curvature.
constexpr double along_surface = 0.15;

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

// xx yy zz xy xz yz of a symmetric matrix.
using Symmetric = Eigen::Matrix<double, 6, 1>;

Symmetric square_of(const Vec3d& e) {
    Symmetric square;
    square << e.x() * e.x(), e.y() * e.y(), e.z() * e.z(), e.x() * e.y(), e.x() * e.z(), e.y() * e.z();
    return square;
}

Mat3d matrix_of(const Symmetric& s) {
    Mat3d matrix;
    matrix << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return matrix;
}

// One link of a vertex.
struct Spoke {
    Vec3d edge;
    double length;
    Symmetric square; // e eᵀ
    double contact;
    double along; // work space: dᵀ C d
};

// Those of one vertex after another, in the same memory.
class Star {
public:
    void read(const Graph& graph, std::span<const Vec3d> position, std::span<const float> contact,
              std::size_t vertex) {
        spokes_.clear();
        for (Index link = graph.first[vertex]; link < graph.first[vertex + 1]; ++link) {
            const Vec3d edge = position[graph.neighbor[link]] - position[vertex];
            spokes_.push_back({edge, edge.norm(), square_of(edge), static_cast<double>(contact[link]), 0});
        }
    }

    std::span<Spoke> spokes() { return spokes_; }

private:
    std::vector<Spoke> spokes_;
};

// How unevenly a vertex pulls: Σ w e, and Σ w |e|.
struct Pull {
    Vec3d sum = Vec3d::Zero();
    double effort = 0;
};

Pull pull_of(std::span<const Spoke> star, std::span<const double> weight) {
    Pull pull;
    for (std::size_t k = 0; k < star.size(); ++k) {
        pull.sum += weight[k] * star[k].edge;
        pull.effort += weight[k] * star[k].length;
    }
    return pull;
}

// Returns the sum of the weights, which they keep.
double start_weights(std::span<const Spoke> star, std::span<double> weight) {
    double longest = 0;
    for (const Spoke& spoke : star) longest = std::max(longest, spoke.length);
    // Samples may come to lie on each other in the course of edits; their link counts as a short one.
    const double shortest = longest > 0 ? 1e-3 * longest : 1;
    for (std::size_t k = 0; k < star.size(); ++k)
        weight[k] = star[k].contact / std::max(star[k].length, shortest);
    const Pull pull = pull_of(star, weight);
    const double share = pull.effort > 0 ? pull.sum.norm() / pull.effort : 0;
    const double sum = sum_inside * (1 - std::numbers::pi / 4 * share);
    normalize(weight, sum);
    return sum;
}

// What follows every update: the sum is as it was and no weight vanishes.
void finish_update(std::span<double> weight, double sum) {
    normalize(weight, sum);
    const double least = std::min(least_weight, least_share * sum / static_cast<double>(weight.size()));
    for (double& w : weight) w = std::max(w, least);
}

Symmetric spread_of(std::span<const Spoke> star, std::span<const double> weight) {
    Symmetric spread = Symmetric::Zero();
    for (std::size_t k = 0; k < star.size(); ++k) spread += weight[k] * star[k].square;
    return spread;
}

// One update of a vertex's weights towards pulling as much along each direction.
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

// The projection onto the directions that a vertex is to balance along.
Mat3d along_surface_of(std::span<const Spoke> star, std::span<const double> weight) {
    Eigen::SelfAdjointEigenSolver<Mat3d> axes;
    axes.computeDirect(matrix_of(spread_of(star, weight)));
    Mat3d along = Mat3d::Zero();
    for (int k = 0; k < 3; ++k)
        if (axes.eigenvalues()[k] > along_surface * axes.eigenvalues()[2])
            along += axes.eigenvectors().col(k) * axes.eigenvectors().col(k).transpose();
    return along;
}

// One update towards pulls that cancel.
void balance(std::span<const Spoke> star, const Mat3d& along, double border, double sum,
             std::span<double> weight) {
    const Pull pull = pull_of(star, weight);
    const Vec3d uneven = along * pull.sum; // Σ w e along the surface
    const double share = pull.effort > 0 ? uneven.norm() / pull.effort : 1;
    const double inside = std::clamp((border - share) / border_fades, 0.0, 1.0);
    if (inside > 0) {
        const Mat3d spread = matrix_of(spread_of(star, weight));
        // C⁺ of what is uneven: across the surface the matrix is filled up so that it has an inverse.
        const Mat3d filled = along * spread * along + spread.trace() * (Mat3d::Identity() - along);
        const Vec3d counter = filled.inverse() * uneven;
        for (std::size_t k = 0; k < weight.size(); ++k)
            weight[k] *= std::clamp(1 - inside * counter.dot(star[k].edge), 0.5, 1.5);
    }
    finish_update(weight, sum);
}

} // namespace

std::vector<double> isotropic_weights(const Graph& graph, std::span<const Vec3d> position,
                                      std::span<const float> contact, double border, Workers& workers) {
    require(contact.size() == graph.neighbor.size(), "a contact a link");
    const std::vector<Index> back = reverse_links(graph);
    std::vector<double> one_way(graph.neighbor.size());
    std::vector<double> weight(graph.neighbor.size());
    const auto for_stars = [&](auto&& update) {
        workers.for_chunks(graph.size(), 256, [&](std::size_t begin, std::size_t end) {
            Star star;
            for (std::size_t v = begin; v < end; ++v) {
                star.read(graph, position, contact, v);
                const auto own = std::span(one_way).subspan(graph.first[v], star.spokes().size());
                if (!own.empty()) update(v, star.spokes(), own);
            }
        });
        workers.for_each(weight.size(), 1 << 14, [&](std::size_t link) {
            weight[link] = 0.5 * (one_way[link] + one_way[back[link]]);
        });
    };
    std::vector<Mat3d> along(graph.size());
    std::vector<double> sum(graph.size());
    for_stars([&along, &sum](std::size_t v, std::span<Spoke> star, std::span<double> own) {
        sum[v] = start_weights(star, own);
        for (int update = 0; update < updates; ++update) even_out(star, sum[v], own);
        along[v] = along_surface_of(star, own);
    });
    for (int round = 0; round < balancing_rounds; ++round) {
        one_way = weight;
        for_stars([&along, &sum, border](std::size_t v, std::span<Spoke> star, std::span<double> own) {
            even_out(star, sum[v], own);
            balance(star, along[v], border, sum[v], own);
        });
    }
    return weight;
}

} // namespace knead

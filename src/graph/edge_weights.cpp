#include "graph/edge_weights.h"

#include "base/require.h"
#include "graph/star_weights.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <numeric>
#include <utility>

namespace knead {

namespace {

constexpr int updates = 4;

constexpr int balancing_rounds = 3;

// So much below the bound for borders a vertex begins to be taken for one on a border.
constexpr double border_fades = 0.2;

// A vertex balances along a direction that holds as much of the spread as this, compared with the widest one;
// across a surface Σ w e is its curvature.
constexpr double along_surface = 0.15;

Mat3d matrix_of(const Symmetric& s) {
    Mat3d matrix;
    matrix << s[0], s[3], s[4], s[3], s[1], s[5], s[4], s[5], s[2];
    return matrix;
}

// Those of one vertex after another, in the same memory.
class Star {
public:
    void read(const Graph& graph, std::span<const Vec3d> position, std::span<const float> contact,
              std::size_t vertex) {
        spokes_.clear();
        for (Index link = graph.first[vertex]; link < graph.first[vertex + 1]; ++link) {
            const Vec3d edge = position[graph.neighbor[link]] - position[vertex];
            spokes_.push_back(spoke_along(edge, static_cast<double>(contact[link])));
        }
    }

    std::span<Spoke> spokes() { return spokes_; }

private:
    std::vector<Spoke> spokes_;
};

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

// Pulls p = Σ w e that are left make vertices yield when the surface is stretched evenly, and it resists less
// than by its area: by 2 |p|² / (Σ w · Σ w |e|²) where one yields alone, and by so many times as much where
// all do.
constexpr double yield_together = 4, most_yielded = 0.35;

// Of a vertex that is to balance; none on a border.
double yielded_alone(std::span<const Spoke> star, const Mat3d& along, double border,
                     std::span<const double> weight) {
    const Pull pull = pull_of(star, weight);
    const double left = (along * pull.sum).norm();
    const double resisted = area_of(star, weight) * std::accumulate(weight.begin(), weight.end(), 0.0);
    if (left >= border * pull.effort || !(resisted > 0)) return 0;
    return 2 * left * left / resisted;
}

// A vertex may be made so many times larger or smaller than the others are on average: where a territory
// tells more than that, its sample is a poor likeness of it whatever its links weigh.
constexpr double most_scaled = 4;

// How many times the sum 6 c each vertex needs to stand for as much of the surface as it is to.
struct Scales {
    std::span<const double> wanted; // area of each vertex, 0: not known; empty: all are 1
    double on_average = 1;

    double of(std::size_t vertex, double area) const {
        if (wanted.empty() || !(wanted[vertex] > 0 && area > 0)) return on_average;
        const double scale = wanted[vertex] / area / on_average;
        return on_average * std::clamp(scale, 1 / most_scaled, most_scaled);
    }
};

Scales scales_of(std::span<const double> wanted, std::span<const double> area) {
    Scales scales{wanted};
    double all = 0, all_wanted = 0;
    for (std::size_t v = 0; v < wanted.size(); ++v) {
        if (!(wanted[v] > 0)) continue;
        all += area[v];
        all_wanted += wanted[v];
    }
    if (all > 0) scales.on_average = all_wanted / all;
    return scales;
}

// All vertices' own weights, each of its links, and the mean of both directions.
class TwoWays {
public:
    TwoWays(const Graph& graph, std::span<const Vec3d> position, std::span<const float> contact,
            Workers& workers)
        : graph_(graph), position_(position), contact_(contact), workers_(workers),
          back_(reverse_links(graph)), own_(graph.neighbor.size()), mean_(graph.neighbor.size()) {}

    // Calls update(vertex, star, its own weights) for each that has links.
    template<typename Update>
    void for_stars(Update&& update) {
        workers_.for_chunks(graph_.size(), 256, [&](std::size_t begin, std::size_t end) {
            Star star;
            for (std::size_t v = begin; v < end; ++v) {
                star.read(graph_, position_, contact_, v);
                const auto own = std::span(own_).subspan(graph_.first[v], star.spokes().size());
                if (!own.empty()) update(v, star.spokes(), own);
            }
        });
    }

    void average() {
        workers_.for_each(mean_.size(), 1 << 14,
                          [&](std::size_t link) { mean_[link] = 0.5 * (own_[link] + own_[back_[link]]); });
    }

    void go_on_from_mean() { own_ = mean_; }

    std::vector<double> take() { return std::move(mean_); }

private:
    const Graph& graph_;
    std::span<const Vec3d> position_;
    std::span<const float> contact_;
    Workers& workers_;
    std::vector<Index> back_; // of each link
    std::vector<double> own_, mean_;
};

void multiply(std::span<double> weight, double times) {
    for (double& w : weight) w *= times;
}

// Makes each vertex resist by so much more as it and those around it yield on the mean.
void make_up_for_yielding(const Graph& graph, const std::vector<Mat3d>& along, double border,
                          TwoWays& weights) {
    std::vector<double> yielded(graph.size(), 0);
    weights.go_on_from_mean();
    weights.for_stars([&](std::size_t v, std::span<Spoke> star, std::span<double> own) {
        yielded[v] = yielded_alone(star, along[v], border, own);
    });
    weights.for_stars([&](std::size_t v, std::span<Spoke>, std::span<double> own) {
        const auto row = graph.row(v);
        double sum = yielded[v];
        for (const Index u : row) sum += yielded[u];
        const double mean = sum / static_cast<double>(row.size() + 1);
        multiply(own, 1 / (1 - std::min(yield_together * mean, most_yielded)));
    });
    weights.average();
}

} // namespace

std::vector<double> isotropic_weights(const Graph& graph, std::span<const Vec3d> position,
                                      std::span<const float> contact, const WeightsOf& of,
                                      std::span<const double> area, Workers& workers) {
    require(contact.size() == graph.neighbor.size(), "a contact a link");
    require(area.empty() || area.size() == graph.size(), "an area a vertex");
    TwoWays weights(graph, position, contact, workers);
    std::vector<Mat3d> along(graph.size());
    std::vector<double> sum(graph.size()), own_area(graph.size());
    weights.for_stars([&](std::size_t v, std::span<Spoke> star, std::span<double> own) {
        sum[v] = start_weights(star, own);
        for (int update = 0; update < updates; ++update) even_out(star, sum[v], own);
        along[v] = along_surface_of(star, own);
        own_area[v] = area_of(star, own);
    });
    const Scales scales = scales_of(area, own_area);
    if (!area.empty())
        weights.for_stars([&](std::size_t v, std::span<Spoke>, std::span<double> own) {
            multiply(own, scales.of(v, own_area[v]));
        });
    weights.average();
    for (int round = 0; round < balancing_rounds; ++round) {
        weights.go_on_from_mean();
        weights.for_stars([&](std::size_t v, std::span<Spoke> star, std::span<double> own) {
            even_out(star, sum[v], own); // with the sum 6 c, whatever it was
            balance(star, along[v], of.border, sum[v], own);
            multiply(own, scales.of(v, area_of(star, own)));
        });
        weights.average();
    }
    if (of.may_yield && !area.empty()) make_up_for_yielding(graph, along, of.border, weights);
    return weights.take();
}

} // namespace knead

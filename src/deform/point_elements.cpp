#include "deform/point_elements.h"

#include "base/new_processors.h"
#include "deform/stretch.h"
#include "graph/balanced_weights.h"
#include "graph/bridges.h"
#include "graph/star_weights.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace knead {

namespace {

// A handle, and a row.
constexpr std::size_t most_blends = 1 + influences_per_row;

Vec3d position_of(const PointsBetween& between, Index vertex) {
    return point_at(between.positions, between.point[vertex]);
}

// What the row of a vertex says: its places' weights w, and their shares v in how it turns.
struct RowWeights {
    Influence influence; // w
    std::array<float, influences_per_row> share;
};

// v at p: those of the samples alone, where a handle is among them that turns as these do. It is left out by
// being as far as the farthest, so that what else there is changes as smoothly as it does with it.
std::array<float, influences_per_row> shares_without(std::span<const bool> left_out, WideRow row,
                                                     const PointsBetween& between, const Vec3d& p) {
    const Index farthest = row.distance[left_out.size() - 1];
    for (std::size_t k = 0; k < left_out.size(); ++k)
        if (left_out[k]) row.distance[k] = farthest;
    auto share = weights_of(row, between.nearest.first_handle, between.weights);
    for (std::size_t k = 0; k < left_out.size(); ++k)
        if (left_out[k]) share[k] = 0;
    if (between.weights == InfluenceWeights::smooth) balance(offsets_from(p, row, between.sample), share);
    const float of_all = std::accumulate(share.begin(), share.end(), 0.0F);
    for (float& each : share) each /= of_all;
    return share;
}

// What moves a vertex, at p, by its row. A sample's own one goes and turns with the sample, though smooth
// weights blend it when it is moved: what samples do that every blend of them hides is told there alone.
// Without it few samples may never come to rest (the survey's cylinder with 50 of them).
RowWeights weights_at(const PointsBetween& between, Index vertex, const Vec3d& p) {
    const WideRow row = between.nearest[vertex];
    const Index first_handle = between.nearest.first_handle;
    const bool is_sample = row.distance[0] == 0 && row.sample[0] < first_handle;
    RowWeights result;
    result.influence = influence_of(row, first_handle, is_sample ? InfluenceWeights::paper : between.weights,
                                    offsets_from(p, row, between.sample));
    result.share = result.influence.weight;
    const std::size_t count = result.influence.count;
    std::array<bool, influences_per_row> left_out{};
    for (std::size_t k = 0; k < count; ++k)
        left_out[k] =
            row.sample[k] >= first_handle && is_set(between.turns_by_samples, row.sample[k] - first_handle);
    const auto is_in = [](bool out) { return !out; };
    const std::span told(left_out.data(), count);
    // One that has handles alone around it turns with them.
    if (is_sample || std::ranges::all_of(told, is_in) || std::ranges::none_of(told, is_in)) return result;
    result.share = shares_without(told, row, between, p);
    return result;
}

// Weights in double: as floats they sum to 1 within their last digits only, and whatever all bodies do alike
// would count with what is missing. A cloud that is moved far by all its handles would pull at itself.
std::array<double, influences_per_row> summing_to_one(std::span<const float> weights) {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::array<double, influences_per_row> result{};
    std::ranges::transform(weights, result.begin(),
                           [&](float weight) { return static_cast<double>(weight) / sum; });
    return result;
}

// What a body does at a vertex.
struct Blend {
    Vec3d arm = Vec3d::Zero();   // w c
    Vec3d place = Vec3d::Zero(); // v p_s
    double weight = 0;           // w
    double share = 0;            // v
    Index body = 0;
};

// Those of one vertex after another, in the same memory.
class Blends {
public:
    explicit Blends(const PointsBetween& between) : between_(between) {}

    std::span<const Blend> read(Index vertex) {
        count_ = 0;
        p_ = short_of_ = position_of(between_, vertex);
        const Index handle = between_.label[vertex];
        const bool is_held = handle != no_index;
        const bool turns_freely = is_set(between_.turns_freely, handle);
        if (is_held) add(handle_body(handle), 1, turns_freely ? 0 : 1);
        if (!is_held || turns_freely) add_row(vertex, is_held);
        if (between_.weights == InfluenceWeights::smooth) bow();
        return {blend_.data(), count_};
    }

private:
    bool is_sample(Index body) const { return body < between_.sample.size(); }
    Index handle_body(Index handle) const { return static_cast<Index>(between_.sample.size()) + handle; }
    Index body_of(Index motion) const {
        return motion < between_.nearest.first_handle ? motion
                                                      : handle_body(motion - between_.nearest.first_handle);
    }

    // What the row of a vertex says: of how it turns alone, if a handle moves it.
    void add_row(Index vertex, bool is_held) {
        const auto [influence, share] = weights_at(between_, vertex, p_);
        const auto weights = summing_to_one(std::span(influence.weight).first(influence.count));
        const auto shares = summing_to_one(std::span(share).first(influence.count));
        for (std::size_t k = 0; k < influence.count; ++k)
            add(body_of(influence.motion[k]), is_held ? 0 : weights[k], shares[k]);
    }

    void add(Index body, double weight, double share) {
        const Vec3d place = is_sample(body) ? between_.sample[body] : p_;
        const Vec3d arm = is_sample(body) ? Vec3d(p_ - place) : p_;
        blend_[count_++] = {weight * arm, share * place, weight, share, body};
        short_of_ -= weight * place;
    }

    // Along arcs: a sample's own arm counts half, and for all of them half of where the blend falls short.
    void bow() {
        for (std::size_t k = 0; k < count_; ++k) {
            Blend& blend = blend_[k];
            if (is_sample(blend.body)) blend.arm *= 0.5;
            blend.arm += 0.5 * blend.weight * short_of_;
        }
    }

    const PointsBetween& between_;
    Vec3d p_ = Vec3d::Zero();        // where the vertex is
    Vec3d short_of_ = Vec3d::Zero(); // p - Σ w p_s
    std::array<Blend, most_blends> blend_;
    std::size_t count_ = 0;
};

// Adds what blends say, of the elements at these places, from that way off with the weight that the inverse
// spread gives it: to the gradients, and to G.
KNEAD_FOR_NEW_PROCESSORS_TOO
void add_slopes(std::span<const Blend> blends, std::span<const std::size_t> place, const Vec3d& way,
                std::span<Element> elements, Columns& slope) {
    Four along = {}, arm = {}, of_place = {};
    set_four(way, along);
    for (std::size_t k = 0; k < blends.size(); ++k) {
        Element& element = elements[place[k]];
        set_four(blends[k].arm, arm);
        set_four(blends[k].place, of_place);
        element.gradient += blends[k].weight * along;
        element.corrected += blends[k].share * along;
        add_outer(arm, way, element.arms);
        add_outer(of_place, way, slope);
    }
}

// G⁻ᵀ, G along the surface and the identity across it; but where the blend climbs less than the positions do,
// 1 for what would be more: at a rim, where all samples are on one side, it would count for too much.
Mat3d correction_of(const Mat3d& slope, const Mat3d& along) {
    const Mat3d filled = along * slope * along + (Mat3d::Identity() - along);
    Eigen::SelfAdjointEigenSolver<Mat3d> squares;
    squares.computeDirect(filled.transpose() * filled);
    const auto inverse = [](double square) {
        const double slope_along = std::sqrt(std::max(square, 1e-6));
        return 1 / (slope_along * std::max(slope_along, 1.0));
    };
    const Vec3d inverses = squares.eigenvalues().unaryExpr(inverse);
    return filled * squares.eigenvectors() * inverses.asDiagonal() * squares.eigenvectors().transpose();
}

bool is_zero(const Four& four) {
    return vector_of(four).isZero(0);
}

// Drops elements that say nothing: of the farthest around, with smooth weights.
void drop_nothing(Contribution& contribution) {
    std::size_t kept = 0;
    for (std::size_t at = 0; at < contribution.element.size(); ++at) {
        const Element& element = contribution.element[at];
        if (element.share == 0 && is_zero(element.gradient) && is_zero(element.corrected) &&
            std::ranges::all_of(element.arms.of, is_zero))
            continue;
        contribution.body[kept] = contribution.body[at];
        contribution.element[kept++] = element;
    }
    contribution.body.resize(kept);
    contribution.element.resize(kept);
}

// The links of a vertex to others that do not hang.
struct Links {
    Mat3d spread = Mat3d::Zero(); // Σ e eᵀ
    Pull pull;                    // Σ e, Σ |e|
};

Links links_of(const PointsBetween& between, const Vec3d& position, std::span<const Index> row) {
    Links links;
    for (const Index other : row) {
        const Vec3d edge = position_of(between, other) - position;
        links.spread += edge * edge.transpose();
        links.pull.sum += edge;
        links.pull.effort += edge.norm();
    }
    return links;
}

} // namespace

ContributionFinder::ContributionFinder(const PointsBetween& between)
    : between_(between), place_(between.sample.size() + 2 * between.handles, no_index) {}

// Where the element of a body stands.
std::size_t ContributionFinder::place_of(Index body) {
    Index& place = place_[body];
    if (place == no_index) {
        place = static_cast<Index>(found_.body.size());
        found_.body.push_back(body);
        found_.element.emplace_back();
    }
    return place;
}

// Adds what a vertex and its neighbours say of the gradients. Returns G. `inverse`: of the spread of its
// links.
Mat3d ContributionFinder::add_gradients(Index vertex, const Vec3d& position, const Mat3d& inverse) {
    Columns slope;
    Blends blends(between_);
    std::array<std::size_t, most_blends> place{};
    const auto add = [&](Index at, const Vec3d& way) {
        const std::span<const Blend> all = blends.read(at);
        for (std::size_t k = 0; k < all.size(); ++k) place[k] = place_of(all[k].body);
        add_slopes(all, place, way, found_.element, slope);
        return all;
    };
    Vec3d sum = Vec3d::Zero();
    for (const Index other : row_) {
        const Vec3d way = inverse * (position_of(between_, other) - position);
        sum += way;
        add(other, way);
    }
    for (const Blend& blend : add(vertex, -sum)) found_.element[place_[blend.body]].share += blend.share;
    return matrix_of(slope);
}

// Adds how much of the links around a vertex lies within handles. `squares`: Σ |e|².
void ContributionFinder::add_growths(Index vertex, const Vec3d& position, double squares) {
    const auto grows = [&](Index handle) {
        return handle != no_index && !is_set(between_.turns_freely, handle);
    };
    const auto add = [&](Index handle, double square) {
        if (grows(handle))
            found_.element[place_of(static_cast<Index>(between_.sample.size() + between_.handles) + handle)]
                .share += square / squares;
    };
    const Index own = between_.label[vertex];
    for (const Index other : row_) {
        const Index handle = between_.label[other];
        if (!grows(own) && !grows(handle)) continue;
        const double square = (position_of(between_, other) - position).squaredNorm();
        add(own, 0.5 * square);
        add(handle, 0.5 * square);
    }
}

// As the base sample says that is the nearest to the vertex; 1 where handles alone are around it.
double ContributionFinder::area_of_links(Index vertex) const {
    if (between_.area_of_links.empty()) return 1;
    for (const Index sample : between_.nearest[vertex].sample)
        if (sample < between_.area_of_links.size())
            return static_cast<double>(between_.area_of_links[sample]);
    return 1;
}

const Contribution& ContributionFinder::find(Index vertex) {
    found_.body.clear();
    found_.element.clear();
    row_.clear();
    for (const Index other : between_.graph.row(vertex))
        if (!hangs(between_.hanging, other)) row_.push_back(other);
    if (row_.size() < 2) return found_;
    const Vec3d position = position_of(between_, vertex);
    const Links links = links_of(between_, position, row_);
    if (!(links.pull.effort > 0)) return found_;
    const Surroundings surroundings = surroundings_of(links.spread);
    const Mat3d along = Mat3d::Identity() - surroundings.open;
    set_columns(along, found_.along);
    found_.dimension = std::max(1.0, along.trace());
    const double square_length = links.spread.trace() / static_cast<double>(row_.size());
    found_.measure =
        3 / found_.dimension * square_length * share_of_directions(links.pull) * area_of_links(vertex);
    const Mat3d slope = add_gradients(vertex, position, surroundings.inverse);
    add_growths(vertex, position, links.spread.trace());
    for (const Index body : found_.body) place_[body] = no_index;
    drop_nothing(found_);
    const Mat3d correction = correction_of(slope, along);
    for (Element& element : found_.element)
        set_four(correction * vector_of(element.corrected), element.corrected);
    return found_;
}

} // namespace knead

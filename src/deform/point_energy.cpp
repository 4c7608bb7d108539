#include "deform/point_energy.h"

#include "base/require.h"
#include "deform/stretch.h"
#include "graph/balanced_weights.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace knead {

namespace {

// From so many samples to so many the energy of the points fades. Sooner, the horse is farther off with 2000
// samples than with 200 (legs on a body: links are a poor likeness of the crotch); later, a long bar that is
// twisted by two turns is farther behind its handles (knead evaluate), and 5000 samples take longer.
constexpr double few_samples = 300, many_samples = 4000;

// Where so many or fewer points stand for a sample links are as near on average, and less uneven, and the
// energy fades at once.
constexpr double enough_points = 15, too_few_points = 5, many_samples_of_them = 450;

constexpr std::size_t points_a_sample = 32, fewest_points = 16384;

// Points whose sums are made together, by one worker, are near each other and meet few bodies: as many as
// around so many samples.
constexpr std::size_t samples_a_part = 16;

// From 0 to 1 on the way between these, of which either may be the greater.
double ramp(double at, double from, double to) {
    return std::clamp((at - from) / (to - from), 0.0, 1.0);
}

bool hangs(const PointsBetween& between, Index vertex) {
    return !between.hanging.empty() && between.hanging[vertex] != 0;
}

// The handle that moves a vertex alone, or no_index.
Index holder_of(const PointsBetween& between, Index vertex) {
    const Index handle = between.label[vertex];
    const bool turns = handle < between.turns_freely.size() && between.turns_freely[handle];
    return turns ? no_index : handle;
}

// What moves a vertex, at p, that no handle does alone. A sample's own one goes with the sample, though
// smooth weights blend it when it is moved: what samples do that every blend of them hides is told there
// alone. Without it few samples may never come to rest (the survey's cylinder with 50 of them).
Influence influence_at(const PointsBetween& between, Index vertex, const Vec3d& p) {
    const WideRow row = between.nearest[vertex];
    const Index first_handle = between.nearest.first_handle;
    const bool is_sample = row.distance[0] == 0 && row.sample[0] < first_handle;
    return influence_of(row, first_handle, is_sample ? InfluenceWeights::paper : between.weights,
                        offsets_from(p, row, between.sample));
}

// What a body does at a vertex.
struct Blend {
    Index body = 0;
    double weight = 0;
    Vec3d arm = Vec3d::Zero();   // w c
    Vec3d place = Vec3d::Zero(); // w p_s
};

// Those of a vertex, one after another in the same memory.
class Blends {
public:
    explicit Blends(const PointsBetween& between) : between_(between) {}

    Vec3d position(Index vertex) const { return point_at(between_.positions, between_.point[vertex]); }

    std::span<const Blend> read(Index vertex) {
        const Vec3d p = position(vertex);
        count_ = 0;
        if (const Index handle = holder_of(between_, vertex); handle != no_index) {
            add(handle_body(handle), 1, p);
        } else {
            const Influence influence = influence_at(between_, vertex, p);
            for (std::size_t k = 0; k < influence.count; ++k)
                add(body_of(influence.motion[k]), static_cast<double>(influence.weight[k]), p);
        }
        if (between_.weights == InfluenceWeights::smooth) bow(p);
        return {blend_.data(), count_};
    }

private:
    bool is_sample(Index body) const { return body < between_.sample.size(); }
    Index handle_body(Index handle) const { return static_cast<Index>(between_.sample.size()) + handle; }
    Index body_of(Index motion) const {
        return motion < between_.nearest.first_handle ? motion
                                                      : handle_body(motion - between_.nearest.first_handle);
    }

    void add(Index body, double weight, const Vec3d& p) {
        const Vec3d place = is_sample(body) ? between_.sample[body] : p;
        const Vec3d arm = is_sample(body) ? Vec3d(p - place) : p;
        blend_[count_++] = {body, weight, weight * arm, weight * place};
    }

    // Along arcs: a sample's own arm counts half, and for all of them half of where the blend falls short.
    void bow(const Vec3d& p) {
        Vec3d short_of = p;
        for (std::size_t k = 0; k < count_; ++k) short_of -= blend_[k].place;
        for (std::size_t k = 0; k < count_; ++k) {
            Blend& blend = blend_[k];
            if (is_sample(blend.body)) blend.arm *= 0.5;
            blend.arm += 0.5 * blend.weight * short_of;
        }
    }

    const PointsBetween& between_;
    std::array<Blend, influences_per_row> blend_;
    std::size_t count_ = 0;
};

// A body at a vertex, with its gradients.
struct Element {
    Index body = 0;
    double weight = 0;
    double square_reach = 0;         // |p - p_s|² of a sample
    Vec3d gradient = Vec3d::Zero();  // g
    Mat3d arms = Mat3d::Zero();      // H
    Vec3d corrected = Vec3d::Zero(); // ĝ
};

// All that one vertex adds.
struct Contribution {
    double measure = 0;          // ω
    double dimension = 0;        // tr P
    Mat3d along = Mat3d::Zero(); // P
    std::vector<Element> elements;
};

Element& element_of(std::vector<Element>& elements, Index body) {
    for (Element& element : elements)
        if (element.body == body) return element;
    elements.push_back({});
    elements.back().body = body;
    return elements.back();
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

// Adds what the neighbours of a vertex, at `row`, say of the gradients. Returns G.
Mat3d add_gradients(std::span<const Index> row, const Vec3d& position, const Surroundings& surroundings,
                    std::span<const Blend> own, Blends& blends, std::vector<Element>& elements) {
    Mat3d slope = Mat3d::Zero();
    const auto add = [&](const Blend& blend, const Vec3d& along) {
        Element& element = element_of(elements, blend.body);
        element.gradient += blend.weight * along;
        for (int column = 0; column < 3; ++column) { // a whole product would go by way of memory
            element.arms.col(column) += along[column] * blend.arm;
            slope.col(column) += along[column] * blend.place;
        }
    };
    Vec3d sum = Vec3d::Zero();
    for (const Index other : row) {
        const Vec3d along = surroundings.inverse * (blends.position(other) - position);
        sum += along;
        for (const Blend& blend : blends.read(other)) add(blend, along);
    }
    for (const Blend& blend : own) add(blend, -sum);
    return slope;
}

// Whether a vertex can add anything: not where one handle moves it and all its neighbours.
bool is_between(const PointsBetween& between, Index vertex) {
    if (hangs(between, vertex)) return false;
    const Index handle = holder_of(between, vertex);
    if (handle == no_index) return true;
    return std::ranges::any_of(between.graph.row(vertex),
                               [&](Index other) { return holder_of(between, other) != handle; });
}

// So many of those that can, or all if there are no more, evenly spread along the order of the vertices.
std::vector<Index> spread_between(const PointsBetween& between, std::size_t wanted, Workers& workers) {
    constexpr std::size_t vertices_a_chunk = 1 << 14;
    const std::size_t vertices = between.graph.size();
    std::vector<std::size_t> before((vertices + vertices_a_chunk - 1) / vertices_a_chunk + 1, 0);
    const auto for_those_of = [&](std::size_t chunk, auto&& visit) {
        const std::size_t end = std::min((chunk + 1) * vertices_a_chunk, vertices);
        for (std::size_t v = chunk * vertices_a_chunk; v < end; ++v)
            if (is_between(between, static_cast<Index>(v))) visit(static_cast<Index>(v));
    };
    workers.for_each(before.size() - 1, 1,
                     [&](std::size_t chunk) { for_those_of(chunk, [&](Index) { ++before[chunk + 1]; }); });
    std::partial_sum(before.begin(), before.end(), before.begin());
    const std::size_t all = before.back(), count = std::min(all, wanted);
    std::vector<Index> chosen(count);
    // Each k is met once: where rank · count / all comes to k + 1.
    workers.for_each(before.size() - 1, 1, [&](std::size_t chunk) {
        std::size_t rank = before[chunk];
        for_those_of(chunk, [&](Index vertex) {
            const std::size_t k = rank * count / all;
            ++rank;
            if (rank * count / all > k) chosen[k] = vertex;
        });
    });
    return chosen;
}

// What a vertex adds. Returns whether it is anything. `row` is work space.
bool contribution_of(const PointsBetween& between, Index vertex, Blends& blends, std::vector<Index>& row,
                     Contribution& result) {
    row.clear();
    for (const Index other : between.graph.row(vertex))
        if (!hangs(between, other)) row.push_back(other);
    if (row.size() < 2) return false;
    const Vec3d position = blends.position(vertex);
    Mat3d spread = Mat3d::Zero();
    Vec3d pull = Vec3d::Zero();
    double effort = 0;
    for (const Index other : row) {
        const Vec3d edge = blends.position(other) - position;
        spread += edge * edge.transpose();
        pull += edge;
        effort += edge.norm();
    }
    if (!(effort > 0)) return false;
    const Surroundings surroundings = surroundings_of(spread);
    result.along = Mat3d::Identity() - surroundings.open;
    result.dimension = std::max(1.0, result.along.trace());
    const double square_length = spread.trace() / static_cast<double>(row.size());
    const double share = 1 - std::numbers::pi / 4 * pull.norm() / effort;
    result.measure = 3 / result.dimension * square_length * share;
    result.elements.clear();
    const std::span<const Blend> read = blends.read(vertex);
    const std::vector<Blend> own(read.begin(), read.end());
    for (const Blend& blend : own) {
        Element& element = element_of(result.elements, blend.body);
        element.weight = blend.weight;
        if (blend.body < between.sample.size())
            element.square_reach = (position - between.sample[blend.body]).squaredNorm();
    }
    const Mat3d slope = add_gradients(row, position, surroundings, own, blends, result.elements);
    std::erase_if(result.elements, [](const Element& element) { // the farthest around, of smooth weights
        return element.weight == 0 && element.gradient.isZero(0) && element.arms.isZero(0);
    });
    const Mat3d correction = correction_of(slope, result.along);
    for (Element& element : result.elements) element.corrected = correction * element.gradient;
    return !result.elements.empty();
}

// Two that have met, at a point.
struct MetPair {
    Index sample = 0, body = 0;
    BodyPair pair;
    PairSlopes slopes;
};

void add_pair(const Contribution& at, const Element& t, const Element& s, MetPair& sums) {
    BodyPair& pair = sums.pair;
    pair.way += at.measure * t.gradient.dot(s.gradient);
    pair.turn += at.measure * t.corrected.dot(s.corrected);
    const Vec3d pulled = at.measure * t.gradient;
    for (int column = 0; column < 3; ++column) pair.map_force += pulled[column] * s.arms.col(column);
    if (s.weight > 0)
        for (int column = 0; column < 3; ++column)
            pair.target_force += s.weight * pulled[column] * at.along.col(column);
    if (!(t.weight > 0)) return; // a neighbour's
    PairSlopes& slopes = sums.slopes;
    const double twice = 2 * at.measure * t.weight;
    slopes.way_slope += twice * s.gradient;
    slopes.map_slope += twice * s.arms;
    if (s.weight > 0) slopes.target_spread += twice * s.weight * at.along;
}

void add_sums(const BodyPair& other, BodyPair& pair) {
    pair.way += other.way;
    pair.turn += other.turn;
    pair.map_force += other.map_force;
    pair.target_force += other.target_force;
}

void add_sums(const PairSlopes& other, PairSlopes& slopes) {
    slopes.way_slope += other.way_slope;
    slopes.map_slope += other.map_slope;
    slopes.target_spread += other.target_spread;
}

// The sums over some points.
struct Part {
    std::vector<Index> met;    // bodies, in the order in which they were met
    std::vector<Mat3d> spread; // of each
    std::vector<double> confidence;
    std::vector<double> reach;  // Σ 2 dim ω w |p - p_s|²
    std::vector<MetPair> pairs; // in the order in which these have met
};

// Where each element's body stands in the part's `met`, contribution after contribution.
std::vector<Index> places_in(Part& part, std::span<const Contribution> contributions) {
    std::vector<Index> places;
    for (const Contribution& at : contributions)
        for (const Element& element : at.elements) {
            const auto found = std::ranges::find(part.met, element.body);
            places.push_back(static_cast<Index>(found - part.met.begin()));
            if (found == part.met.end()) part.met.push_back(element.body);
        }
    return places;
}

Part sum_up(std::span<const Contribution> contributions, std::size_t samples) {
    Part part;
    const std::vector<Index> places = places_in(part, contributions);
    const std::size_t bodies = part.met.size();
    part.spread.assign(bodies, Mat3d::Zero());
    part.confidence.assign(bodies, 0);
    part.reach.assign(bodies, 0);
    std::vector<Index> number(bodies * bodies, no_index); // of each pair of places: in `pairs`
    const Index* place = places.data();
    for (const Contribution& at : contributions) {
        for (std::size_t t = 0; t < at.elements.size(); ++t) {
            const Element& own = at.elements[t];
            if (own.body >= samples) continue;
            part.spread[place[t]] += 2 * at.measure * own.weight * at.along;
            part.confidence[place[t]] += 2 * at.dimension * at.measure * own.weight;
            part.reach[place[t]] += 2 * at.dimension * at.measure * own.weight * own.square_reach;
            for (std::size_t s = 0; s < at.elements.size(); ++s) {
                Index& pair = number[place[t] * bodies + place[s]];
                if (pair == no_index) {
                    pair = static_cast<Index>(part.pairs.size());
                    part.pairs.push_back({own.body, at.elements[s].body, {}, {}});
                }
                add_pair(at, own, at.elements[s], part.pairs[pair]);
            }
        }
        place += at.elements.size();
    }
    return part;
}

// The pairs of all parts, sample after sample, and in the order of the parts.
struct PairsBySample {
    std::vector<std::size_t> first; // one entry a sample, and the end
    std::vector<const MetPair*> pair;

    std::span<const MetPair* const> of(std::size_t sample) const {
        return std::span(pair).subspan(first[sample], first[sample + 1] - first[sample]);
    }
};

PairsBySample by_sample(std::span<const Part> parts, std::size_t samples) {
    PairsBySample result;
    result.first.assign(samples + 2, 0);
    for (const Part& part : parts)
        for (const MetPair& pair : part.pairs) ++result.first[pair.sample + 2];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.pair.resize(result.first.back());
    for (const Part& part : parts)
        for (const MetPair& pair : part.pairs) result.pair[result.first[pair.sample + 1]++] = &pair;
    result.first.pop_back();
    return result;
}

// Which bodies each sample meets.
void number_pairs(const PairsBySample& pairs, PointEnergy& energy) {
    std::vector<Index> row;
    energy.first.assign(1, 0);
    energy.body.reserve(pairs.pair.size());
    for (Index t = 0; t < energy.samples; ++t) {
        row.assign(1, t);
        for (const MetPair* pair : pairs.of(t)) row.push_back(pair->body);
        std::ranges::sort(row);
        energy.body.insert(energy.body.end(), row.begin(), std::unique(row.begin(), row.end()));
        energy.first.push_back(static_cast<Index>(energy.body.size()));
    }
    energy.pair.resize(energy.body.size());
    energy.slopes.resize(energy.body.size());
}

void add_pairs(const PairsBySample& pairs, PointEnergy& energy, Workers& workers) {
    workers.for_each(energy.samples, 64, [&](std::size_t t) {
        const auto begin = energy.body.begin() + energy.first[t];
        const auto end = energy.body.begin() + energy.first[t + 1];
        for (const MetPair* met : pairs.of(t)) {
            const auto at =
                static_cast<std::size_t>(std::lower_bound(begin, end, met->body) - energy.body.begin());
            add_sums(met->pair, energy.pair[at]);
            add_sums(met->slopes, energy.slopes[at]);
        }
    });
}

// What a part says of the samples themselves.
void add_part(const Part& part, PointEnergy& energy) {
    for (std::size_t t = 0; t < part.met.size(); ++t) {
        if (part.met[t] >= energy.samples) continue;
        energy.spread[part.met[t]] += part.spread[t];
        energy.confidence[part.met[t]] += part.confidence[t];
        energy.reach[part.met[t]] += part.reach[t];
    }
}

} // namespace

PointEnergy point_energy(const PointsBetween& between, Workers& workers) {
    require(between.label.size() == between.graph.size() && between.nearest.size() == between.graph.size(),
            "an entry a vertex");
    PointEnergy energy;
    energy.samples = between.sample.size();
    energy.bodies = energy.samples + between.handles;
    energy.spread.assign(energy.samples, Mat3d::Zero());
    energy.confidence.assign(energy.samples, 0);
    energy.reach.assign(energy.samples, 0);
    if (energy.samples == 0) return energy;
    const std::vector<Index> asked =
        spread_between(between, std::max(points_a_sample * energy.samples, fewest_points), workers);
    const std::size_t points = asked.size();
    const std::size_t points_a_part = std::max<std::size_t>(16, samples_a_part * points / energy.samples);
    std::vector<Part> parts((points + points_a_part - 1) / points_a_part);
    workers.for_each(parts.size(), 1, [&](std::size_t part) {
        Blends blends(between);
        std::vector<Contribution> contributions;
        Contribution contribution;
        std::vector<Index> row;
        for (std::size_t k = part * points_a_part; k < std::min((part + 1) * points_a_part, points); ++k)
            if (contribution_of(between, asked[k], blends, row, contribution))
                contributions.push_back(contribution);
        parts[part] = sum_up(contributions, energy.samples);
    });
    const PairsBySample pairs = by_sample(parts, energy.samples);
    number_pairs(pairs, energy);
    add_pairs(pairs, energy, workers);
    for (const Part& part : parts) add_part(part, energy);
    for (std::size_t s = 0; s < energy.samples; ++s)
        energy.reach[s] = energy.confidence[s] > 0 ? std::sqrt(energy.reach[s] / energy.confidence[s]) : 0;
    return energy;
}

double share_of_points(std::size_t samples, std::size_t vertices) {
    if (samples == 0) return 0;
    const auto count = static_cast<double>(samples);
    const double between = ramp(static_cast<double>(vertices) / count, too_few_points, enough_points);
    const double soon = ramp(count, many_samples_of_them, few_samples);
    return ramp(count, many_samples, few_samples) * std::max(between, soon);
}

void scale(PointEnergy& energy, double times) {
    for (BodyPair& pair : energy.pair) {
        pair.way *= times;
        pair.turn *= times;
        pair.map_force *= times;
        pair.target_force *= times;
    }
    for (PairSlopes& slopes : energy.slopes) {
        slopes.way_slope *= times;
        slopes.map_slope *= times;
        slopes.target_spread *= times;
    }
    for (Mat3d& spread : energy.spread) spread *= times;
    for (double& confidence : energy.confidence) confidence *= times;
}

} // namespace knead

#include "deform/point_energy.h"

#include "base/new_processors.h"
#include "base/require.h"
#include "deform/point_elements.h"
#include "graph/bridges.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>

namespace knead {

namespace {

// From so many samples to so many the energy of the points fades. Sooner, the horse is farther off with 2000
// samples than with 200 (legs on a body: links are a poor likeness of the crotch); later, a long bar that is
// twisted by two turns is farther behind its handles (knead evaluate), and 5000 samples take longer.
constexpr double few_samples = 300, many_samples = 4000;

// Where so many or fewer points stand for a sample links are as near on average, and less uneven, and the
// energy fades at once: of many samples, and of few as well where nearly every point is one, and there is
// nothing between them.
constexpr double enough_points = 15, too_few_points = 5, many_samples_of_them = 450;

// Points whose sums are made together, by one worker, are near each other and meet few bodies: as many as
// around so many samples; but not so many that there is no part for every worker.
constexpr std::size_t samples_a_part = 64, most_points_a_part = 1024;

// About so many bodies a sample meets in one part.
constexpr std::size_t pairs_a_sample = 96;

// From 0 to 1 on the way between these, of which either may be the greater.
double ramp(double at, double from, double to) {
    return std::clamp((at - from) / (to - from), 0.0, 1.0);
}

// Whether a vertex can add anything: not where one handle moves and turns it and all its neighbours.
bool is_between(const PointsBetween& between, Index vertex) {
    if (hangs(between.hanging, vertex)) return false; // an outlier says nothing of the surface
    const Index handle = between.label[vertex];
    if (handle == no_index || is_set(between.turns_freely, handle)) return true;
    return std::ranges::any_of(between.graph.row(vertex),
                               [&](Index other) { return between.label[other] != handle; });
}

// Which of those that are asked.
std::vector<Index> which_tell(const PointsBetween& between) {
    std::vector<Index> which;
    which.reserve(between.asked.size());
    for (Index k = 0; k < between.asked.size(); ++k)
        if (is_between(between, between.asked[k])) which.push_back(k);
    return which;
}

// What is summed up of two that have met.
struct PairSums {
    Columns map_slope, target_spread, map_product, fit_target;
    Four map_force = {}, target_force = {}, way_slope = {}, fit_way = {};
    double way = 0, turn = 0;
};

void add_sums(const PairSums& sums, std::size_t at, PointEnergy& energy) {
    BodyPair& pair = energy.pair[at];
    PairSlopes& slopes = energy.slopes[at];
    PairFits& fits = energy.fits[at];
    pair.way += sums.way;
    pair.turn += sums.turn;
    pair.map_force += vector_of(sums.map_force);
    pair.target_force += vector_of(sums.target_force);
    slopes.way_slope += vector_of(sums.way_slope);
    slopes.map_slope += matrix_of(sums.map_slope);
    slopes.target_spread += matrix_of(sums.target_spread);
    fits.way += vector_of(sums.fit_way);
    fits.target += matrix_of(sums.fit_target);
    energy.map_products[at] += matrix_of(sums.map_product);
}

// The sums over some points.
struct Part {
    std::vector<Index> met;    // bodies, in the order in which they were met
    std::vector<Mat3d> spread; // of each
    std::vector<double> confidence;

    std::vector<Index> sample, other; // two that have met, in the order in which they did
    std::vector<PairSums> sums;       // of these
};

// One element of a point with all of them.
struct Meeting {
    const Element& own;
    std::span<const Element> all;
    std::span<const Index> pair; // of each: which it is with the sample
    double measure = 0;          // ω
};

KNEAD_FOR_NEW_PROCESSORS_TOO
void add_pairs(const Meeting& meeting, const Columns& along, std::span<PairSums> pairs) {
    const Element& t = meeting.own;
    const Four pulled = meeting.measure * t.gradient, turned = meeting.measure * t.corrected;
    const double twice = 2 * meeting.measure * t.share;
    Four pulled_along = {};
    add_product(along, pulled, pulled_along);
    Columns arms, target_arms; // ω H_t, ω P H_tᵀ
    for (int column = 0; column < 3; ++column) arms.of[column] = meeting.measure * t.arms.of[column];
    const Mat3d across = matrix_of(arms).transpose();
    add_product(along, across, target_arms);
    for (std::size_t at = 0; at < meeting.all.size(); ++at) {
        const Element& s = meeting.all[at];
        PairSums& sums = pairs[meeting.pair[at]];
        sums.way += dot_of(pulled, s.gradient);
        sums.turn += dot_of(turned, s.corrected);
        add_product(s.arms, pulled, sums.map_force);
        sums.target_force += s.share * pulled_along;
        add_product(s.arms, across, sums.map_product);
        add_product(arms, s.gradient, sums.fit_way);
        for (int column = 0; column < 3; ++column)
            sums.fit_target.of[column] += s.share * target_arms.of[column];
        if (!(t.share > 0)) continue; // a neighbour's
        sums.way_slope += twice * s.gradient;
        for (int column = 0; column < 3; ++column) {
            sums.map_slope.of[column] += twice * s.arms.of[column];
            sums.target_spread.of[column] += twice * s.share * along.of[column];
        }
    }
}

// Makes a part, point after point.
class PartSums {
public:
    PartSums(std::size_t samples, std::size_t bodies) : samples_(samples), place_(bodies, no_index) {
        part_.sums.reserve(pairs_a_sample * samples_a_part);
    }

    // One that stands for so many.
    void add(const Contribution& at, double each) {
        const double measure = each * at.measure;
        place_of_element_.clear();
        for (const Index body : at.body) place_of_element_.push_back(place_of(body));
        for (std::size_t t = 0; t < at.element.size(); ++t) {
            if (at.body[t] >= samples_) continue;
            add_own(at, measure, at.element[t], place_of_element_[t]);
            number_pairs_of(t, at.body);
            add_pairs({at.element[t], at.element, pair_of_element_, measure}, at.along, part_.sums);
        }
    }

    Part take() { return std::move(part_); }

private:
    // What a point says of one sample itself.
    void add_own(const Contribution& at, double measure, const Element& own, Index place) {
        part_.spread[place] += 2 * measure * own.share * matrix_of(at.along);
        part_.confidence[place] += 2 * at.dimension * measure * own.share;
    }

    // Where a body stands in the part's `met`.
    Index place_of(Index body) {
        Index& place = place_[body];
        if (place != no_index) return place;
        place = static_cast<Index>(part_.met.size());
        part_.met.push_back(body);
        part_.spread.push_back(Mat3d::Zero());
        part_.confidence.push_back(0);
        if (part_.met.size() > room_) make_room();
        return place;
    }

    // Which of the part's pairs one of these bodies is with each.
    void number_pairs_of(std::size_t sample, std::span<const Index> body) {
        Index* const row = &number_[place_of_element_[sample] * room_];
        pair_of_element_.resize(body.size());
        for (std::size_t s = 0; s < body.size(); ++s) {
            Index& number = row[place_of_element_[s]];
            if (number == no_index) {
                number = static_cast<Index>(part_.sums.size());
                part_.sample.push_back(body[sample]);
                part_.other.push_back(body[s]);
                part_.sums.emplace_back();
            }
            pair_of_element_[s] = number;
        }
    }

    // For twice as many bodies.
    void make_room() {
        const std::size_t room = std::max<std::size_t>(32, 2 * room_);
        std::vector<Index> number(room * room, no_index);
        for (std::size_t row = 0; row < room_; ++row)
            std::copy_n(number_.begin() + static_cast<std::ptrdiff_t>(row * room_), room_,
                        number.begin() + static_cast<std::ptrdiff_t>(row * room));
        number_ = std::move(number);
        room_ = room;
    }

    std::size_t samples_;
    Part part_;
    std::vector<Index> place_;                              // of each body: in `met`
    std::size_t room_ = 0;                                  // for so many bodies
    std::vector<Index> number_;                             // of each two places: in `sums`
    std::vector<Index> place_of_element_, pair_of_element_; // of the point that is added
};

// A body that a sample has met.
struct Met {
    Index body = 0;
    const PairSums* sums = nullptr; // none: that it is among them is all there is to say
};

// Those of all parts, sample after sample.
struct MetBySample {
    std::vector<std::size_t> first; // one entry a sample, and the end
    std::vector<Met> met;

    std::span<Met> of(std::size_t sample) {
        return std::span(met).subspan(first[sample], first[sample + 1] - first[sample]);
    }
};

// The first of each sample is itself, the others are in the order of the parts.
MetBySample by_sample(std::span<const Part> parts, std::size_t samples) {
    MetBySample result;
    result.first.assign(samples + 2, 1);
    result.first[0] = result.first[1] = 0;
    for (const Part& part : parts)
        for (const Index sample : part.sample) ++result.first[sample + 2];
    std::partial_sum(result.first.begin(), result.first.end(), result.first.begin());
    result.met.resize(result.first.back());
    for (Index sample = 0; sample < samples; ++sample) result.met[result.first[sample + 1]++].body = sample;
    for (const Part& part : parts)
        for (std::size_t pair = 0; pair < part.sums.size(); ++pair)
            result.met[result.first[part.sample[pair] + 1]++] = {part.other[pair], &part.sums[pair]};
    result.first.pop_back();
    return result;
}

// The pairs of a sample and what they sum up to: bodies ascending, and each in the order of the parts.
void add_pairs_of(std::span<const Met> met, std::size_t first, PointEnergy& energy) {
    std::size_t at = first;
    for (std::size_t k = 0; k < met.size(); ++k) {
        if (k > 0 && met[k].body != met[k - 1].body) ++at;
        energy.body[at] = met[k].body;
        if (met[k].sums) add_sums(*met[k].sums, at, energy);
    }
}

void add_pairs(std::span<const Part> parts, PointEnergy& energy, Workers& workers) {
    constexpr std::size_t samples_a_time = 64;
    MetBySample all = by_sample(parts, energy.samples);
    energy.first.assign(energy.samples + 1, 0);
    workers.for_each(energy.samples, samples_a_time, [&](std::size_t t) {
        const std::span<Met> met = all.of(t);
        std::ranges::stable_sort(met, {}, &Met::body);
        Index& bodies = energy.first[t + 1] = 1;
        for (std::size_t k = 1; k < met.size(); ++k) bodies += met[k].body != met[k - 1].body ? 1 : 0;
    });
    std::partial_sum(energy.first.begin(), energy.first.end(), energy.first.begin());
    energy.body.resize(energy.first.back());
    energy.pair.resize(energy.body.size());
    energy.slopes.resize(energy.body.size());
    energy.fits.resize(energy.body.size());
    energy.map_products.resize(energy.body.size(), Mat3d::Zero());
    workers.for_each(energy.samples, samples_a_time,
                     [&](std::size_t t) { add_pairs_of(all.of(t), energy.first[t], energy); });
}

// What a part says of the samples themselves.
void add_part(const Part& part, PointEnergy& energy) {
    for (std::size_t t = 0; t < part.met.size(); ++t) {
        if (part.met[t] >= energy.samples) continue;
        energy.spread[part.met[t]] += part.spread[t];
        energy.confidence[part.met[t]] += part.confidence[t];
    }
}

} // namespace

PointEnergy point_energy(const PointsBetween& between, Workers& workers) {
    require(between.label.size() == between.graph.size() && between.nearest.size() == between.graph.size(),
            "an entry a vertex");
    require(between.asked.size() == between.each.size(), "an entry each that is asked");
    PointEnergy energy;
    energy.samples = between.sample.size();
    energy.bodies = energy.samples + 2 * between.handles;
    energy.spread.assign(energy.samples, Mat3d::Zero());
    energy.confidence.assign(energy.samples, 0);
    if (energy.samples == 0) return energy;
    const std::vector<Index> told = which_tell(between);
    const std::size_t points = told.size();
    const std::size_t points_a_part =
        std::clamp<std::size_t>(samples_a_part * points / energy.samples, 16, most_points_a_part);
    std::vector<Part> parts((points + points_a_part - 1) / points_a_part);
    workers.for_each(parts.size(), 1, [&](std::size_t part) {
        PartSums sums(energy.samples, energy.bodies);
        ContributionFinder finder(between);
        for (std::size_t k = part * points_a_part; k < std::min((part + 1) * points_a_part, points); ++k)
            sums.add(finder.find(between.asked[told[k]]), between.each[told[k]]);
        parts[part] = sums.take();
    });
    add_pairs(parts, energy, workers);
    for (const Part& part : parts) add_part(part, energy);
    return energy;
}

double share_of_points(std::size_t samples, std::size_t vertices) {
    if (samples == 0) return 0;
    const auto count = static_cast<double>(samples);
    const double points = static_cast<double>(vertices) / count; // a sample
    const double between = ramp(points, too_few_points, enough_points);
    const double soon = ramp(count, many_samples_of_them, few_samples) * ramp(points, 1, too_few_points);
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

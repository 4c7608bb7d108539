#include "edit/sample_choice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

namespace knead {

namespace {

constexpr std::array<double, 7> rungs{200, 500, 1000, 2000, 5000, 10000, 20000};
constexpr double usual = 2000;
constexpr double most_whole = 1000; // points of which every one is a sample
constexpr double points_a_sample = 4;

// Seconds of a frame; where upsampling alone takes them up, solving still gets its part of them.
constexpr double frame_seconds = 0.025;
constexpr double least_for_solving = frame_seconds / 3;

// Solving takes m to this power for m samples, or to a lower one (README: 1.8 ms an iteration with 10,520 and
// 23 with 101,000).
constexpr double growth = 1.15;

// Fewer than these take hardly less: what they wait for is not theirs, and says nothing about more of them.
constexpr double fewest_telling = 1000;

// What handles ask for: two samples across the smallest, eight between any two, and 20 for a border of each
// from the fifth that they share. Handles of less than 1/1250 of the points get a falloff instead
// (edit/falloffs.h).
constexpr double samples_on_smallest = 4, smallest_counted = 1.0 / 1250;
constexpr double samples_between = 8;
constexpr double samples_a_handle = 20 * 5;

double rung_below(double samples) {
    const auto* const above = std::ranges::upper_bound(rungs, samples);
    return above == rungs.begin() ? rungs.front() : *std::prev(above);
}

// The nearest, rather: one that lacks a fourth is nearer than the next.
double rung_for(double samples) {
    const auto* const found = std::ranges::lower_bound(rungs, 0.75 * samples);
    return found == rungs.end() ? rungs.back() : *found;
}

double wanted_by(const HandleSpread& handles) {
    const double small = samples_on_smallest / std::max(handles.smallest, smallest_counted);
    const double between = samples_between / handles.closest;
    return std::max({small, between * between, samples_a_handle * static_cast<double>(handles.count)});
}

double allowed_by(double points) {
    return points <= most_whole ? points : rung_below(std::max(most_whole, points / points_a_sample));
}

double affordable(const std::optional<FrameCost>& cost) {
    if (!cost || cost->solving <= 0) return std::numeric_limits<double>::infinity();
    const double left = std::max(frame_seconds - cost->upsampling, least_for_solving);
    return std::max(fewest_telling, static_cast<double>(cost->samples)) *
           std::pow(left / cost->solving, 1 / growth);
}

// Where handles are content with so many, and the machine can do so many.
double chosen(double points, double wanted, double affordable) {
    const double allowed = allowed_by(points);
    return std::min({points <= most_whole ? allowed : rung_for(wanted), allowed, rung_below(affordable)});
}

SampleReason reason_for(double samples, double points, double of_handles) {
    if (samples >= points) return SampleReason::few_points;
    if (samples >= rung_for(std::max(usual, of_handles)))
        return rung_for(of_handles) > usual ? SampleReason::handles : SampleReason::enough;
    return samples >= allowed_by(points) ? SampleReason::points : SampleReason::machine;
}

SampleChoice choice_of(double samples, double points, double of_handles) {
    SampleChoice choice{static_cast<std::uint64_t>(samples), reason_for(samples, points, of_handles)};
    if (samples >= points) choice.samples.reset();
    return choice;
}

} // namespace

bool is_faster(const FrameCost& one, const FrameCost& other) {
    return affordable(one) > affordable(other);
}

SampleChoice choose_samples(const SampleNeeds& needs) {
    const auto points = static_cast<double>(needs.points);
    const double of_handles = wanted_by(needs.handles);
    const double samples = chosen(points, std::max(usual, of_handles), affordable(needs.cost));
    return choice_of(samples, points, of_handles);
}

SampleChoice choose_samples_again(const SampleNeeds& needs, std::optional<std::uint64_t> now) {
    const auto points = static_cast<double>(needs.points);
    const double samples = now ? static_cast<double>(*now) : points;
    const double of_handles = wanted_by(needs.handles);
    const double wanted = std::max(usual, of_handles), fits = affordable(needs.cost);
    const double fewest = chosen(points, wanted / calm, fits / calm);
    const double most = chosen(points, wanted * calm, fits * calm);
    const bool could_be_chosen = !now || std::ranges::binary_search(rungs, samples);
    if (!could_be_chosen || samples < fewest || samples > most) return choose_samples(needs);
    return choice_of(samples, points, of_handles);
}

} // namespace knead

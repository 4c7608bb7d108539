#include "cloud/extent.h"

#include "base/require.h"
#include "cloud/point_cloud.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace knead {

namespace {

constexpr double kept_part = 0.95;
constexpr double most_over_mean = 16;

double sum_of(const std::vector<double>& amount) {
    return std::accumulate(amount.begin(), amount.end(), 0.0);
}

// What each point stands for, none more than so many times the mean of what is left then: the mean falls
// from round to round, and ends where no more is cut off.
std::vector<double> limited(std::span<const double> area) {
    constexpr int most_rounds = 100;
    constexpr double nothing_more = 1e-9;
    std::vector<double> amount(area.begin(), area.end());
    double sum = sum_of(amount);
    if (!(sum > 0)) return std::vector<double>(area.size(), 1.0);
    for (int round = 0; round < most_rounds; ++round) {
        const double most = most_over_mean * sum / static_cast<double>(amount.size());
        for (double& each : amount) each = std::min(each, most);
        const double before = std::exchange(sum, sum_of(amount));
        if (before - sum <= nothing_more * before) break;
    }
    return amount;
}

// The place along an axis below which half of the body lies.
double median_along(std::span<const float> positions, const std::vector<double>& amount, std::size_t axis) {
    std::vector<std::pair<float, double>> places(amount.size());
    for (std::size_t i = 0; i < places.size(); ++i) places[i] = {positions[3 * i + axis], amount[i]};
    std::ranges::sort(places);
    double left = sum_of(amount) / 2;
    for (const auto& [place, part] : places)
        if ((left -= part) <= 0) return place;
    return places.back().first;
}

// Lets go of what is the farthest from the middle; of equally far points all count for equally less.
void keep_nearest(std::span<const float> positions, std::vector<double>& amount) {
    const Vec3d middle(median_along(positions, amount, 0), median_along(positions, amount, 1),
                       median_along(positions, amount, 2));
    std::vector<std::pair<double, std::size_t>> by_distance(amount.size());
    for (std::size_t i = 0; i < amount.size(); ++i)
        by_distance[i] = {(point_at(positions, i) - middle).squaredNorm(), i};
    std::ranges::sort(by_distance);
    double left = kept_part * sum_of(amount);
    for (auto first = by_distance.begin(); first != by_distance.end();) {
        const auto last = std::find_if(first, by_distance.end(),
                                       [&](const auto& each) { return each.first > first->first; });
        double here = 0;
        for (auto each = first; each != last; ++each) here += amount[each->second];
        const double kept = here > 0 ? std::clamp(left / here, 0.0, 1.0) : 0;
        for (auto each = first; each != last; ++each) amount[each->second] *= kept;
        left -= here;
        first = last;
    }
}

} // namespace

double cloud_size(std::span<const float> positions, std::span<const double> area) {
    require(positions.size() == 3 * area.size(), "each point stands for something");
    if (area.empty()) return 1;
    std::vector<double> amount = limited(area);
    keep_nearest(positions, amount);
    const double sum = sum_of(amount);
    Vec3d mean = Vec3d::Zero();
    for (std::size_t i = 0; i < amount.size(); ++i) mean += amount[i] / sum * point_at(positions, i);
    double trace = 0;
    for (std::size_t i = 0; i < amount.size(); ++i)
        trace += amount[i] / sum * (point_at(positions, i) - mean).squaredNorm();
    return trace > 0 ? std::sqrt(12 * trace) : std::numeric_limits<float>::min();
}

} // namespace knead

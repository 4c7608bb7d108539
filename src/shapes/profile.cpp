#include "shapes/profile.h"

#include <algorithm>
#include <cmath>

namespace knead {

Profile make_profile(double low, double high, const std::function<double(double)>& weight) {
    constexpr std::size_t steps = 4096;
    Profile profile{low, high, std::vector<double>(steps + 1)};
    const double step = (high - low) / steps;
    for (std::size_t i = 0; i < steps; ++i)
        profile.total[i + 1] = profile.total[i] + step * weight(low + (static_cast<double>(i) + 0.5) * step);
    return profile;
}

double place_of(const Profile& profile, double fraction) {
    const double wanted = fraction * profile.whole();
    const auto above = std::upper_bound(profile.total.begin(), profile.total.end() - 1, wanted);
    const auto step = std::max<std::ptrdiff_t>(above - profile.total.begin() - 1, 0);
    const double below = profile.total[static_cast<std::size_t>(step)];
    const double width = profile.total[static_cast<std::size_t>(step) + 1] - below;
    const double within = width > 0 ? std::clamp((wanted - below) / width, 0.0, 1.0) : 0.0;
    const double steps = static_cast<double>(profile.total.size() - 1);
    return profile.low + (profile.high - profile.low) * (static_cast<double>(step) + within) / steps;
}

std::vector<std::size_t> cut_into_rows(std::size_t points,
                                       const std::function<double(double)>& points_across) {
    const double count = static_cast<double>(points);
    const Profile rows_below =
        make_profile(0, 1, [&](double m) { return count / std::max(1.0, points_across(m)); });
    const std::size_t rows = static_cast<std::size_t>(std::max(1.0, std::round(rows_below.whole())));
    std::vector<std::size_t> first(rows + 1, points);
    for (std::size_t r = 0; r < rows; ++r) {
        const double m = place_of(rows_below, static_cast<double>(r) / static_cast<double>(rows));
        first[r] = std::min(points, static_cast<std::size_t>(std::round(m * count)));
    }
    return first;
}

} // namespace knead

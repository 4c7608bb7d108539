#include "cloud/extent.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr double kept_part = 0.95;

float median(std::vector<float> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

} // namespace

double cloud_size(const PointCloud& cloud) {
    std::vector<Vec3f> points;
    points.reserve(cloud.size());
    for (std::size_t i = 0; i < cloud.size(); ++i)
        if (is_finite(cloud, i)) points.push_back(cloud.position(i));
    if (points.empty()) return 1;

    Vec3f middle;
    std::vector<float> values(points.size());
    for (int axis = 0; axis < 3; ++axis) {
        std::ranges::transform(points, values.begin(), [axis](const Vec3f& p) { return p[axis]; });
        middle[axis] = median(values);
    }
    const auto kept =
        std::max<std::ptrdiff_t>(1, std::lround(kept_part * static_cast<double>(points.size())));
    const auto distance = [&](const Vec3f& p) {
        return (p.cast<double>() - middle.cast<double>()).squaredNorm();
    };
    std::nth_element(points.begin(), points.begin() + kept - 1, points.end(),
                     [&](const Vec3f& a, const Vec3f& b) {
                         const double da = distance(a), db = distance(b);
                         if (da != db) return da < db;
                         return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
                     });
    points.resize(static_cast<std::size_t>(kept));

    Vec3d mean = Vec3d::Zero();
    for (const Vec3f& p : points) mean += p.cast<double>();
    mean /= static_cast<double>(points.size());
    double trace = 0;
    for (const Vec3f& p : points) trace += (p.cast<double>() - mean).squaredNorm();
    trace /= static_cast<double>(points.size());
    return trace > 0 ? std::sqrt(12 * trace) : std::numeric_limits<float>::min();
}

} // namespace knead

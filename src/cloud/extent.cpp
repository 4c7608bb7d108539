#include "cloud/extent.h"

#include "base/workers.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr double kept_part = 0.95;
constexpr std::size_t grain = 1 << 14;

std::vector<Vec3f> finite_points(std::span<const float> positions) {
    std::vector<Vec3f> points;
    points.reserve(positions.size() / 3);
    for (std::size_t i = 0; i < positions.size(); i += 3)
        if (const Vec3f p(positions[i], positions[i + 1], positions[i + 2]); p.allFinite())
            points.push_back(p);
    return points;
}

// The median along each axis.
Vec3f middle_of(const std::vector<Vec3f>& points, Workers& workers) {
    Vec3f middle;
    workers.for_each(3, 1, [&](std::size_t axis) {
        std::vector<float> values(points.size());
        std::ranges::transform(points, values.begin(),
                               [axis](const Vec3f& p) { return p[static_cast<Eigen::Index>(axis)]; });
        const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
        std::nth_element(values.begin(), at, values.end());
        middle[static_cast<Eigen::Index>(axis)] = *at;
    });
    return middle;
}

// Of each point the distance from there, squared.
std::vector<double> squared_distances(const std::vector<Vec3f>& points, const Vec3f& from, Workers& workers) {
    std::vector<double> squared(points.size());
    workers.for_each(points.size(), grain, [&](std::size_t i) {
        squared[i] = (points[i].cast<double>() - from.cast<double>()).squaredNorm();
    });
    return squared;
}

// The so many nearest to the middle; of equally far ones the first by coordinates.
std::vector<Vec3f> nearest(const std::vector<Vec3f>& points, std::size_t count, Workers& workers) {
    const std::vector<double> squared = squared_distances(points, middle_of(points, workers), workers);
    std::vector<double> sorted = squared;
    std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(count) - 1, sorted.end());
    const double farthest = sorted[count - 1];
    std::vector<Vec3f> kept, on_the_edge;
    kept.reserve(count);
    for (std::size_t i = 0; i < points.size(); ++i) {
        if (squared[i] < farthest) kept.push_back(points[i]);
        if (squared[i] == farthest) on_the_edge.push_back(points[i]);
    }
    std::ranges::sort(on_the_edge, [](const Vec3f& a, const Vec3f& b) {
        return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
    });
    on_the_edge.resize(count - kept.size());
    kept.insert(kept.end(), on_the_edge.begin(), on_the_edge.end());
    return kept;
}

} // namespace

double cloud_size(const PointCloud& cloud, Workers& workers) {
    return cloud_size(cloud.positions, workers);
}

double cloud_size(std::span<const float> positions, Workers& workers) {
    std::vector<Vec3f> points = finite_points(positions);
    if (points.empty()) return 1;
    const auto count = std::lround(kept_part * static_cast<double>(points.size()));
    points = nearest(points, std::max<std::size_t>(1, static_cast<std::size_t>(count)), workers);

    Vec3d mean = Vec3d::Zero();
    for (const Vec3f& p : points) mean += p.cast<double>();
    mean /= static_cast<double>(points.size());
    double trace = 0;
    for (const Vec3f& p : points) trace += (p.cast<double>() - mean).squaredNorm();
    trace /= static_cast<double>(points.size());
    return trace > 0 ? std::sqrt(12 * trace) : std::numeric_limits<float>::min();
}

} // namespace knead

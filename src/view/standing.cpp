#include "view/standing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>
#include <vector>

namespace knead {

namespace {

constexpr std::size_t most_points = 50'000;
constexpr double strays = 0.002; // of the points, at either end of an axis
constexpr double lowest = 0.03;  // of the extent
constexpr double surveyed = 100; // so many times farther away than it is large, and sideways
constexpr double least_share = 0.2, least_share_above = 0.5, clearly = 1.5;

using Place = glm::dvec3;
using Flat = std::pair<double, double>;

std::vector<Place> some_of(std::span<const float> positions) {
    const std::size_t count = positions.size() / 3, step = count / most_points + 1;
    std::vector<Place> places;
    for (std::size_t i = 0; i < count; i += step)
        places.emplace_back(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    return places;
}

struct Extent {
    double low, high;
};
Extent extent_along(glm::length_t axis, const std::vector<Place>& places) {
    std::vector<double> along;
    along.reserve(places.size());
    for (const Place& place : places) along.push_back(place[axis]);
    std::ranges::sort(along);
    const auto out = static_cast<std::size_t>(strays * static_cast<double>(along.size()));
    return {along[out], along[along.size() - 1 - out]};
}

// Twice the area of the triangle, positive where it turns left.
double turn_of(const Flat& a, const Flat& b, const Flat& c) {
    return (b.first - a.first) * (c.second - a.second) - (b.second - a.second) * (c.first - a.first);
}

// The area of the convex hull, twice: Andrew's monotone chain, once along and once back.
double area_of_hull(std::vector<Flat> points) {
    std::ranges::sort(points);
    double area = 0;
    for (int way = 0; way < 2; ++way, std::ranges::reverse(points)) {
        std::vector<Flat> chain;
        for (const Flat& point : points) {
            while (chain.size() > 1 && turn_of(chain.end()[-2], chain.back(), point) <= 0) chain.pop_back();
            chain.push_back(point);
        }
        for (std::size_t i = 1; i < chain.size(); ++i)
            area += chain[i - 1].first * chain[i].second - chain[i].first * chain[i - 1].second;
    }
    return area;
}

// How much of what is below the cloud its lowest points cover, 0 … 1.
double support(UpAxis up, const std::array<Extent, 3>& extents, const std::vector<Place>& places) {
    const auto [axis, sign] = upward(up);
    const glm::length_t across = 3 - axis;
    const auto [low, high] = extents[static_cast<std::size_t>(axis)];
    std::vector<Flat> all, lowest_of_all;
    const auto is_stray = [&](const Place& place) {
        for (glm::length_t a = 0; a < 3; ++a) {
            const Extent& extent = extents[static_cast<std::size_t>(a)];
            if (place[a] < extent.low || place[a] > extent.high) return true;
        }
        return false;
    };
    for (const Place& place : places) {
        if (is_stray(place)) continue;
        all.emplace_back(place.x, place[across]);
        const double height = sign > 0 ? place[axis] - low : high - place[axis];
        if (height <= lowest * (high - low)) lowest_of_all.push_back(all.back());
    }
    const double area = area_of_hull(std::move(all));
    return area > 0 ? area_of_hull(std::move(lowest_of_all)) / area : 0;
}

bool is_of_survey(const std::array<Extent, 3>& extents, const Vec3d& origin) {
    double size = 0;
    for (const Extent& extent : extents) size = std::max(size, extent.high - extent.low);
    const double sideways = std::max(std::abs(origin.x()), std::abs(origin.y()));
    return sideways > surveyed * size && sideways > surveyed * std::abs(origin.z());
}

} // namespace

std::optional<UpAxis> standing_axis(std::span<const float> positions, const Vec3d& origin) {
    const std::vector<Place> places = some_of(positions);
    if (places.empty()) return std::nullopt;
    const std::array<Extent, 3> extents = {extent_along(0, places), extent_along(1, places),
                                           extent_along(2, places)};
    if (is_of_survey(extents, origin)) return UpAxis::z;
    const double y = support(UpAxis::y, extents, places), z = support(UpAxis::z, extents, places);
    if (z >= least_share && z >= clearly * y) return UpAxis::z;
    if (y >= least_share && y >= clearly * z) return UpAxis::y;
    if (std::max(y, z) < least_share && support(UpAxis::minus_y, extents, places) >= least_share_above)
        return UpAxis::minus_y;
    return std::nullopt;
}

} // namespace knead

#include "view/middle_along.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <vector>

namespace knead {

namespace {

// In spacings: how far from the line points are looked at, how far apart surfaces lie, and how thick what is
// no surface but full of points. (At a slant of 70° a surface is 8 thick along the line, so near to it.)
constexpr double reach = 1.5, gap = 3, full = 9;

// How far along the ray those points are that lie within `radius` of it and not before `least`, in order.
std::vector<double> along(const Ray& ray, double radius, double least, std::span<const float> positions,
                          std::span<const std::uint8_t> hidden, Workers& workers) {
    constexpr std::size_t grain = 65536;
    const std::size_t count = positions.size() / 3;
    std::vector<std::vector<double>> found((count + grain - 1) / grain); // of every chunk
    workers.for_chunks(count, grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const float* const p = positions.data() + 3 * i;
            const glm::dvec3 from_origin = glm::dvec3(p[0], p[1], p[2]) - ray.origin;
            const double far = glm::dot(from_origin, ray.direction);
            const glm::dvec3 aside = from_origin - far * ray.direction;
            if (!(far >= least && glm::dot(aside, aside) <= radius * radius)) continue;
            if (hidden.empty() || hidden[i] == 0) found[begin / grain].push_back(far);
        }
    });
    std::vector<double> all;
    for (const std::vector<double>& some : found) all.insert(all.end(), some.begin(), some.end());
    std::ranges::sort(all);
    return all;
}

double mean(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

} // namespace

std::optional<glm::dvec3> middle_along(const Ray& ray, bool from_afar, std::span<const float> positions,
                                       std::span<const std::uint8_t> hidden, double spacing,
                                       Workers& workers) {
    const double least = from_afar ? -std::numeric_limits<double>::max() : 0;
    const std::vector<double> depths = along(ray, reach * spacing, least, positions, hidden, workers);
    if (depths.empty()) return std::nullopt;
    // The surface that begins with number `first`.
    const auto surface = [&](std::size_t first) {
        std::size_t end = first + 1;
        while (end < depths.size() && depths[end] - depths[end - 1] <= gap * spacing) ++end;
        return std::span(depths).subspan(first, end - first);
    };
    const std::span<const double> front = surface(0);
    double middle = mean(front);
    if (front.back() - front.front() > full * spacing)
        middle = 0.5 * (front.front() + front.back());
    else if (front.size() < depths.size())
        middle = 0.5 * (middle + mean(surface(front.size())));
    return ray.origin + middle * ray.direction;
}

} // namespace knead

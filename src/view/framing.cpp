#include "view/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace knead {

namespace {

// A part of the points, evenly spread over their order, is enough to tell percentiles by.
constexpr std::size_t most_looked_at = 200'000;

} // namespace

Box3 bulk_box(std::span<const float> positions) {
    const std::size_t points = positions.size() / 3;
    if (points == 0) return {glm::dvec3(-0.5), glm::dvec3(0.5)};
    const std::size_t step = (points + most_looked_at - 1) / most_looked_at;
    Box3 box;
    std::vector<float> values;
    for (int axis = 0; axis < 3; ++axis) {
        values.clear();
        for (std::size_t i = 0; i < points; i += step)
            values.push_back(positions[3 * i + static_cast<std::size_t>(axis)]);
        std::ranges::sort(values);
        const std::size_t left_out = values.size() / 500;
        const double low = values[left_out], high = values[values.size() - 1 - left_out];
        // A cloud goes on a little beyond its percentiles.
        const double room = 0.2 * (high - low);
        box.lowest[axis] = std::max<double>(values.front(), low - room);
        box.highest[axis] = std::min<double>(values.back(), high + room);
    }
    return box;
}

void frame_points(Camera& camera, std::span<const float> positions, Viewport viewport) {
    const std::size_t points = positions.size() / 3;
    const std::size_t step = std::max<std::size_t>(1, (points + most_looked_at - 1) / most_looked_at);
    const glm::dquat to_camera = glm::conjugate(camera.orientation);
    std::vector<float> turned;
    for (std::size_t i = 0; i < points; i += step) {
        const glm::vec3 p(to_camera *
                          glm::dvec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]));
        turned.insert(turned.end(), {p.x, p.y, p.z});
    }
    Camera straight = camera;
    straight.orientation = glm::dquat(1, 0, 0, 0);
    frame(straight, bulk_box(turned), viewport);
    straight.pivot = camera.orientation * straight.pivot;
    straight.orientation = camera.orientation;
    camera = straight;
}

double usual_spacing(std::span<const float> positions) {
    constexpr std::size_t looked_at = 2000, window = 32, wanted = 5;
    const std::size_t points = positions.size() / 3;
    const auto at = [&](std::size_t i) {
        return glm::vec3(positions[3 * i], positions[3 * i + 1], positions[3 * i + 2]);
    };
    std::vector<float> distances;
    for (std::size_t sample = 0; sample < std::min(points, looked_at); ++sample) {
        const std::size_t i = sample * points / std::min(points, looked_at);
        const glm::vec3 here = at(i);
        std::vector<float> near;
        const std::size_t end = std::min(points, i + window + 1);
        for (std::size_t j = i < window ? 0 : i - window; j < end; ++j) {
            const float distance = glm::distance(here, at(j));
            if (distance > 0) near.push_back(distance);
        }
        if (near.empty()) continue;
        const std::size_t place = std::min(wanted, near.size()) - 1;
        std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(place));
        distances.push_back(near[place]);
    }
    if (distances.empty()) return 1; // one point, or all at one place
    const auto usual = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() * 3 / 4);
    std::ranges::nth_element(distances, usual);
    return *usual;
}

} // namespace knead

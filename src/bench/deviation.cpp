#include "bench/deviation.h"

#include "base/require.h"
#include "base/workers.h"
#include "bench/bare_pipeline.h"
#include "deform/rotation.h"
#include "edit/pipeline.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr std::size_t surroundings = 12;

// The points of a cloud that are nearest to a place at rest, the nearest first.
struct Nearest {
    std::array<std::size_t, surroundings> point{};
    std::array<double, surroundings> square;
    std::size_t count = 0;

    void offer(std::size_t i, double distance) {
        if (count == surroundings && distance >= square.back()) return;
        std::size_t place = count < surroundings ? count++ : surroundings - 1;
        for (; place > 0 && square[place - 1] > distance; --place) {
            square[place] = square[place - 1];
            point[place] = point[place - 1];
        }
        square[place] = distance;
        point[place] = i;
    }
};

Nearest nearest_to(const Vec3d& place, const PosedCloud& cloud) {
    Nearest nearest;
    for (std::size_t i = 0; i < cloud.points; ++i)
        nearest.offer(i, (point_at(cloud.rest, i) - place).squaredNorm());
    return nearest;
}

// Where the cloud's pose sends a place near it.
Vec3d sent(const Vec3d& place, const PosedCloud& cloud) {
    const Nearest nearest = nearest_to(place, cloud);
    Vec3d rest = Vec3d::Zero(), posed = Vec3d::Zero();
    const auto count = static_cast<double>(nearest.count);
    for (std::size_t k = 0; k < nearest.count; ++k) {
        rest += point_at(cloud.rest, nearest.point[k]) / count;
        posed += point_at(cloud.posed, nearest.point[k]) / count;
    }
    Mat3d moments = Mat3d::Zero();
    for (std::size_t k = 0; k < nearest.count; ++k)
        moments += (point_at(cloud.posed, nearest.point[k]) - posed) *
                   (point_at(cloud.rest, nearest.point[k]) - rest).transpose();
    const Quatd turn = nearest_rotation(moments, Quatd::Identity());
    const std::size_t first = nearest.point.front();
    return point_at(cloud.posed, first) + turn * (place - point_at(cloud.rest, first));
}

} // namespace

Deviation deviation_between(std::span<const float> a, std::span<const float> b, double diagonal) {
    require(a.size() == b.size(), "two poses of one cloud");
    double sum = 0;
    double largest = 0;
    for (std::size_t i = 0; i + 3 <= a.size(); i += 3) {
        double square = 0;
        for (std::size_t c = i; c < i + 3; ++c) {
            if (!std::isfinite(a[c])) continue;
            const double way = double{a[c]} - double{b[c]};
            square += way * way;
        }
        sum += square;
        largest = std::max(largest, square);
    }
    const double unit = diagonal > 0 ? diagonal : 1;
    const double points = std::max(1.0, static_cast<double>(a.size()) / 3);
    return {std::sqrt(sum / points) / unit, std::sqrt(largest) / unit};
}

Deviation field_deviation(const PosedCloud& a, const PosedCloud& b, double diagonal, Workers& workers) {
    require(a.points > 0 && b.points > 0, "two samplings of one surface");
    constexpr std::size_t grain = 64;
    std::vector<double> squares(a.points);
    workers.for_each(a.points, grain, [&](std::size_t i) {
        squares[i] = (point_at(a.posed, i) - sent(point_at(a.rest, i), b)).squaredNorm();
    });
    double sum = 0, largest = 0;
    for (const double square : squares) {
        sum += square;
        largest = std::max(largest, square);
    }
    const double unit = diagonal > 0 ? diagonal : 1;
    return {std::sqrt(sum / static_cast<double>(a.points)) / unit, std::sqrt(largest) / unit};
}

double link_noise(const Pipeline& pipeline, std::span<const float> posed) {
    const PointOrder& order = pipeline.order();
    const Graph& graph = pipeline.graph();
    const std::vector<Index>& label = pipeline.labels().vertex;
    const Components& components = pipeline.components();
    const std::vector<bool> held = held_parts(pipeline);

    double sum = 0;
    std::size_t links = 0;
    for (Index v = 0; v < graph.size(); ++v) {
        if (!held[components.component[v]]) continue;
        const Index from = order.first_point[v];
        for (const Index w : graph.row(v)) {
            if (w < v || (label[v] != no_index && label[w] != no_index)) continue;
            const Index to = order.first_point[w];
            const double rest =
                (point_at(pipeline.opened().positions, to) - point_at(pipeline.opened().positions, from))
                    .norm();
            const double now = (point_at(posed, to) - point_at(posed, from)).norm();
            // Neighbours that were pressed into one point count as a thousandth.
            const double stretch = std::log(std::max(now / rest, 1e-3));
            sum += stretch * stretch;
            ++links;
        }
    }
    return links > 0 ? std::sqrt(sum / static_cast<double>(links)) : 0;
}

} // namespace knead

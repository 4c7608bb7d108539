#include "bench/air_neighbors.h"

#include "base/workers.h"
#include "bench/bare_pipeline.h"
#include "deform/rotation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

namespace {

// p → p + a p + b, of one sample.
struct AirSample {
    Vec3d rest;
    Mat3d a;
    Vec3d b;
    Vec3d displaced(const Vec3d& p) const { return a * p + b; }
};

AirSample of_handle(const Vec3d& rest, const HandleMotion& motion) {
    return {rest, motion.linear - Mat3d::Identity(), motion.offset};
}

std::vector<AirSample> moved_samples(const Pipeline& pipeline, const std::vector<HandleMotion>& motions,
                                     const SampleState& state) {
    std::vector<AirSample> samples;
    for (std::size_t s = 0; s < pipeline.samples().size(); ++s) {
        const Index vertex = pipeline.samples()[s];
        const Vec3d rest = point_at(pipeline.opened().positions, pipeline.order().first_point[vertex]);
        const Index handle = pipeline.handle_of(pipeline.labels().vertex[vertex]);
        if (handle < motions.size()) {
            samples.push_back(of_handle(rest, motions[handle]));
        } else {
            const Mat3d a = turn_of(state.rotation[s]);
            samples.push_back({rest, a, state.displacement[s] - a * rest});
        }
    }
    return samples;
}

// The displacement of a free point by the eight samples nearest in space.
Vec3d displaced(const Vec3d& p, const std::vector<AirSample>& samples) {
    struct Near {
        double square;
        const AirSample* sample;
    };
    std::array<Near, influences_per_row> nearest;
    std::size_t count = 0;
    for (const AirSample& sample : samples) {
        const double square = (sample.rest - p).squaredNorm();
        if (count == nearest.size() && square >= nearest.back().square) continue;
        std::size_t place = count < nearest.size() ? count++ : count - 1;
        for (; place > 0 && nearest[place - 1].square > square; --place) nearest[place] = nearest[place - 1];
        nearest[place] = {square, &sample};
    }
    const double farthest = std::sqrt(nearest[count - 1].square);
    Vec3d sum = Vec3d::Zero();
    double weights = 0;
    for (std::size_t k = 0; k < count; ++k) {
        const double nearness = farthest > 0 ? 1 - std::sqrt(nearest[k].square) / farthest : 1;
        sum += nearness * nearness * nearest[k].sample->displaced(p);
        weights += nearness * nearness;
    }
    return weights > 0 ? Vec3d(sum / weights) : nearest[0].sample->displaced(p);
}

} // namespace

std::vector<float> posed_through_the_air(const Pipeline& pipeline, const std::vector<HandleMotion>& motions,
                                         const SampleState& state, Workers& workers) {
    const std::vector<AirSample> samples = moved_samples(pipeline, motions, state);
    const Components& components = pipeline.components();
    const std::vector<bool> held = held_parts(pipeline);

    const std::span<const float> opened = pipeline.opened().positions;
    std::vector<float> posed(opened.begin(), opened.end());
    constexpr std::size_t grain = 256;
    workers.for_each(pipeline.order().points(), grain, [&](std::size_t i) {
        if (!held[components.component[pipeline.order().vertex[i]]]) return;
        const Vec3d p = point_at(opened, i);
        const Index handle = pipeline.handle_of(pipeline.labels().point[i]);
        const Vec3d way =
            handle < motions.size() ? of_handle(p, motions[handle]).displaced(p) : displaced(p, samples);
        for (int c = 0; c < 3; ++c) posed[3 * i + static_cast<std::size_t>(c)] += static_cast<float>(way[c]);
    });
    return posed;
}

} // namespace knead

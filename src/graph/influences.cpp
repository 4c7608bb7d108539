#include "graph/influences.h"

#include "graph/flood.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t width = influences_per_row;

double weight_of(double distance, double farthest, InfluenceWeights weights) {
    if (weights == InfluenceWeights::paper) return 1 / (distance * distance);
    const double nearness = 1 - distance / farthest;
    return nearness * nearness;
}

// The weights of `count` ≥ 1 samples at ascending distances, summing to 1.
void fill_weights(const std::uint32_t* distances, std::size_t count, InfluenceWeights weights,
                  float* result) {
    double raw[width] = {};
    double sum = 0;
    if (distances[0] == 0) {
        raw[0] = sum = 1;
    } else {
        const double farthest = distances[count - 1];
        for (std::size_t e = 0; e < count; ++e) sum += raw[e] = weight_of(distances[e], farthest, weights);
        if (!(sum > 0)) { // all as far as the farthest
            for (std::size_t e = 0; e < count; ++e) raw[e] = 1;
            sum = static_cast<double>(count);
        }
    }
    for (std::size_t e = 0; e < width; ++e) result[e] = static_cast<float>(raw[e] / sum);
}

} // namespace

InfluenceRows influence_rows(std::span<const NearestSamples> nearest, InfluenceWeights weights,
                             Workers& workers) {
    InfluenceRows rows;
    rows.sample.assign(nearest.size() * width, 0);
    rows.weight.assign(nearest.size() * width, 0);
    workers.for_each(nearest.size(), 4096, [&](std::size_t v) {
        const std::size_t count = nearest[v].count();
        if (count == 0) return;
        Index* samples = rows.sample.data() + v * width;
        std::fill_n(samples, width, nearest[v].sample[0]);
        std::copy_n(nearest[v].sample.data(), count, samples);
        fill_weights(nearest[v].distance.data(), count, weights, rows.weight.data() + v * width);
    });
    return rows;
}

InfluenceRows own_rows(std::size_t vertices) {
    InfluenceRows rows;
    rows.sample.reserve((vertices + 1) * width);
    rows.weight.reserve((vertices + 1) * width);
    for (std::size_t v = 0; v < vertices; ++v) append_single(rows, static_cast<Index>(v));
    return rows;
}

Index append_single(InfluenceRows& rows, Index sample) {
    const auto row = static_cast<Index>(rows.size());
    rows.sample.insert(rows.sample.end(), width, sample);
    rows.weight.push_back(1);
    rows.weight.insert(rows.weight.end(), width - 1, 0);
    return row;
}

} // namespace knead

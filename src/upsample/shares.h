#pragma once
// Private to this room: what moves one point, in shares that sum to all.

#include "graph/balanced_weights.h"

#include <algorithm>
#include <array>
#include <cstdint>

namespace knead {

inline constexpr std::uint16_t whole_share = 65535;

// What moves one point, the first `count`: 0 for a motion that moves nothing, else its number and 1. Weights
// are up to a common factor, and 0 behind `count`.
struct Movers {
    std::array<Index, influences_per_row> motion;
    std::array<float, influences_per_row> weight{};
    std::size_t count = 0;
};

inline Movers moved_alone(Index motion) {
    Movers movers;
    movers.motion[0] = motion;
    movers.weight[0] = 1;
    movers.count = 1;
    return movers;
}

// Whether nothing about a row is special, as nearly everywhere: it is full, of samples that are not all as
// far, and weights are smooth. Then all that are nearer than the last count.
template<typename Number>
bool is_usual(const SampleRow<Number>& row, Index first_handle, InfluenceWeights weights) {
    Number last = 0;
    for (const Number sample : row.sample) last = std::max(last, sample);
    return weights == InfluenceWeights::smooth && last < first_handle && row.sample.back() != row.none &&
           row.distance.front() != row.distance.back();
}

template<typename Number>
Movers movers_of_usual(const SampleRow<Number>& row, const SampleOffsets* offsets) {
    const Number farthest = row.distance.back();
    Movers movers;
    for (std::size_t k = 0; k < influences_per_row; ++k) {
        const auto nearness = static_cast<float>(static_cast<Number>(farthest - row.distance[k]));
        movers.motion[k] = Index{row.sample[k]} + 1;
        movers.weight[k] = nearness * nearness;
        movers.count += row.distance[k] != farthest ? 1 : 0;
    }
    if (offsets) balance(*offsets, movers.weight);
    return movers;
}

template<typename Number>
Movers movers_of_unusual(const SampleRow<Number>& row, Index first_handle, InfluenceWeights weights,
                         const SampleOffsets* offsets) {
    const std::size_t count = row.count();
    if (count == 0) return moved_alone(0);
    const auto by_distance = weights_of(row, first_handle, weights);
    auto weight = by_distance;
    if (offsets) balance(*offsets, weight);
    Movers movers;
    for (std::size_t k = 0; k < count; ++k) {
        if (!(by_distance[k] > 0)) continue;
        movers.motion[movers.count] = Index{row.sample[k]} + 1;
        movers.weight[movers.count] = weight[k];
        ++movers.count;
    }
    return movers;
}

// By its row, balanced where there are offsets. Which motions they are goes by distance alone: without
// offsets they are the same. `first_handle`: of InfluenceRows.
template<typename Number>
Movers movers_of(const SampleRow<Number>& row, Index first_handle, InfluenceWeights weights,
                 const SampleOffsets* offsets) {
    return is_usual(row, first_handle, weights) ? movers_of_usual(row, offsets)
                                                : movers_of_unusual(row, first_handle, weights, offsets);
}

// Their weights in parts of `whole_share`. What rounding leaves over, or takes too much, is the heaviest's.
inline std::array<std::uint16_t, influences_per_row> shares_of(const Movers& movers) {
    static_assert(influences_per_row == 8);
    const auto& w = movers.weight;
    const float sum = ((w[0] + w[4]) + (w[1] + w[5])) + ((w[2] + w[6]) + (w[3] + w[7]));
    const float scale = float{whole_share} / sum;
    std::array<std::int32_t, influences_per_row> parts;
    std::int32_t left = whole_share;
    for (std::size_t k = 0; k < influences_per_row; ++k) {
        // No weight is negative. NOLINTNEXTLINE(bugprone-incorrect-roundings)
        parts[k] = static_cast<std::int32_t>(w[k] * scale + 0.5F);
        left -= parts[k];
    }
    *std::ranges::max_element(parts) += left;
    std::array<std::uint16_t, influences_per_row> shares;
    for (std::size_t k = 0; k < influences_per_row; ++k) shares[k] = static_cast<std::uint16_t>(parts[k]);
    return shares;
}

} // namespace knead

#pragma once
// Which samples move a point, and how much each: the w_s of Equations (4) and (5).

#include "base/types.h"
#include "base/workers.h"

#include <span>
#include <vector>

namespace knead {

inline constexpr std::size_t influences_per_row = 8; // K of the paper

// Rows of K samples with weights that sum to 1, tightly packed: row r holds sample[r K] … sample[r K + K -
// 1]. Unused places at the end of a row repeat its first sample with weight 0.
struct InfluenceRows {
    std::vector<Index> sample;
    std::vector<float> weight;

    std::size_t size() const { return sample.size() / influences_per_row; }
};

// How a sample's weight falls with its distance d from the point.
enum class InfluenceWeights {
    smooth, // (1 - d/d_max)² with d_max the farthest of the K: nothing jumps where the set of the nearest
            // changes
    paper,  // 1/d²
};

struct NearestSamples;

// One row a vertex from the flood's samples and distances; d = 0 takes that sample alone, a lone
// sample and equal distances share evenly. A vertex without samples gets a row of sample 0 with all weights
// 0.
InfluenceRows influence_rows(std::span<const NearestSamples> nearest, InfluenceWeights weights,
                             Workers& workers);

// One row a vertex that is its own sample: sample v at vertex v.
InfluenceRows own_rows(std::size_t vertices);

// Appends a row of a single sample and returns its number.
Index append_single(InfluenceRows& rows, Index sample);

} // namespace knead

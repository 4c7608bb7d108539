#include "upsample/packed_motions.h"

#include "base/require.h"

#include <algorithm>

namespace knead {

namespace {

// Without a branch in the loop, so that a million rows take about a millisecond.
std::size_t one_past_largest(std::span<const Index> numbers) {
    Index largest = 0;
    for (const Index number : numbers) largest = std::max(largest, number);
    return numbers.empty() ? 0 : std::size_t{largest} + 1;
}

} // namespace

void require_valid_input(const UpsampleInput& input, std::size_t motions) {
    const std::size_t points = input.row.size();
    require(input.positions.size() == 3 * points, "a row of influences for every point");
    require(input.normals.empty() || input.normals.size() == 3 * points, "a normal for every point, or none");
    if (points == 0) return;
    require(input.rows != nullptr, "points need influences");
    require(input.rows->sample.size() == input.rows->weight.size(), "a weight for every influence");
    require(one_past_largest(input.row) <= input.rows->size(), "every point's row of influences exists");
    require(one_past_largest(input.rows->sample) <= motions, "every influence's motion exists");
}

void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals) {
    require(motions.size() == motions_prepared, "a frame has as many motions as prepare() was told");
    require(positions.size() == input.positions.size(), "a place for every moved position");
    require(normals.size() == input.normals.size(), "a place for every moved normal");
}

} // namespace knead

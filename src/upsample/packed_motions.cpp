#include "upsample/packed_motions.h"

#include "base/require.h"

#include <algorithm>

namespace knead {

namespace {

// Without a branch in the loop, so that a million numbers take less than a millisecond.
std::size_t one_past_largest(std::span<const Index> numbers) {
    Index largest = 0;
    for (const Index number : numbers) largest = std::max(largest, number);
    return numbers.empty() ? 0 : std::size_t{largest} + 1;
}

// The same of all samples; an empty place is the number before 0.
template<typename Number>
std::size_t one_past_largest_sample(const std::vector<SampleRow<Number>>& rows) {
    Number largest = 0;
    for (const SampleRow<Number>& row : rows)
        for (const Number sample : row.sample) largest = std::max(largest, static_cast<Number>(sample + 1));
    return largest;
}

} // namespace

void require_valid_input(const UpsampleInput& input, std::size_t motions) {
    const std::size_t points = input.mover.size();
    require(input.positions.size() == 3 * points, "something that moves every point");
    require(input.normals.empty() || input.normals.size() == 3 * points, "a normal for every point, or none");
    if (points == 0) return;
    require(input.rows != nullptr, "points need influences");
    require(one_past_largest(input.mover) <= input.rows->size() + motions, "what moves a point exists");
    const auto end = [](const auto& rows) { return one_past_largest_sample(rows); };
    require(std::visit(end, input.rows->rows) <= motions, "every influence's motion exists");
}

void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals) {
    require(motions.size() == motions_prepared, "a frame has as many motions as prepare() was told");
    require(positions.size() == input.positions.size(), "a place for every moved position");
    require(normals.size() == input.normals.size(), "a place for every moved normal");
}

} // namespace knead

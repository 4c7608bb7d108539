#include "upsample/packed_motions.h"

#include "base/require.h"
#include "base/workers.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstring>
#include <type_traits>

namespace knead {

namespace {

constexpr std::size_t grain = 1 << 16;

// The largest of largest_of(range) over ranges of them all, or 0 for none.
template<typename Item, typename LargestOf>
std::size_t largest_of_all(std::span<const Item> items, Workers& workers, LargestOf&& largest_of) {
    std::atomic<std::size_t> largest = 0;
    workers.for_chunks(items.size(), grain, [&](std::size_t begin, std::size_t end) {
        const std::size_t here = largest_of(items.subspan(begin, end - begin));
        std::size_t known = largest;
        while (known < here && !largest.compare_exchange_weak(known, here)) {
        }
    });
    return largest;
}

// Without a branch in the loop, so that a million numbers take less than a millisecond.
std::size_t one_past_largest(std::span<const Index> numbers) {
    Index largest = 0;
    for (const Index number : numbers) largest = std::max(largest, number);
    return std::size_t{largest} + 1;
}

// The samples of a row side by side, in vector registers (GCC and Clang, any processor).
using NarrowSamples = std::uint16_t __attribute__((vector_size(16)));
using WideSamples = std::uint32_t __attribute__((vector_size(32)));

// The same of all samples; an empty place is the number before 0.
template<typename Number>
std::size_t one_past_largest_sample(std::span<const SampleRow<Number>> rows) {
    using Samples = std::conditional_t<sizeof(Number) == 2, NarrowSamples, WideSamples>;
    Samples largest = {};
    for (const SampleRow<Number>& row : rows) {
        Samples past;
        std::memcpy(&past, row.sample.data(), sizeof past);
        past += 1;
        largest = past > largest ? past : largest;
    }
    std::array<Number, influences_per_row> each;
    std::memcpy(each.data(), &largest, sizeof largest);
    return std::ranges::max(each);
}

} // namespace

void pack_motions(std::span<const Motion> motions, InfluenceWeights weights, std::span<PackedMotion> packed) {
    const float half = weights == InfluenceWeights::paper ? 0.0F : 0.5F;
    for (std::size_t m = 0; m < motions.size(); ++m) {
        const float* const map = motions[m].map;
        const float* const place = motions[m].place;
        const float c[3] = {half * place[0], half * place[1], half * place[2]};
        auto& column = packed[m].column;
        for (std::size_t row = 0; row < 3; ++row) {
            const float* const from = map + 4 * row;
            for (std::size_t axis = 0; axis < 3; ++axis) column[axis][row] = from[axis];
            column[3][row] = from[3] + (from[0] * c[0] + from[1] * c[1] + from[2] * c[2]);
            column[row + 1][3] = c[row];
        }
        column[0][3] = 1.0F;
    }
}

void require_valid_input(const UpsampleInput& input, std::size_t motions, Workers& workers) {
    const std::size_t points = input.mover.size();
    require(input.positions.size() == 3 * points, "something that moves every point");
    require(input.normals.empty() || input.normals.size() == 3 * points, "a normal for every point, or none");
    if (points == 0) return;
    require(input.rows != nullptr, "points need influences");
    require(largest_of_all(input.mover, workers, one_past_largest) <= input.rows->size() + motions,
            "what moves a point exists");
    const auto end = [&]<typename Number>(const std::vector<SampleRow<Number>>& rows) {
        return largest_of_all(std::span(rows), workers, one_past_largest_sample<Number>);
    };
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

#include "upsample/checked_input.h"

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

// The largest of all, or 0 for none.
Index largest_of(std::span<const Index> numbers, Workers& workers) {
    std::atomic<Index> largest = 0;
    workers.for_chunks(numbers.size(), grain, [&](std::size_t begin, std::size_t end) {
        Index here = 0; // without a branch in the loop: a million take less than a millisecond
        for (std::size_t i = begin; i < end; ++i) here = std::max(here, numbers[i]);
        Index known = largest;
        while (known < here && !largest.compare_exchange_weak(known, here)) {
        }
    });
    return largest;
}

// The samples of a row side by side, in vector registers (GCC and Clang, any processor).
using NarrowSamples = std::uint16_t __attribute__((vector_size(16)));
using WideSamples = std::uint32_t __attribute__((vector_size(32)));

// One past the largest number in all places; an empty one is the number before 0.
template<typename Number>
Index one_past_largest(std::span<const SampleRow<Number>> rows) {
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

// What these rows may have become since the version that was seen last.
bool changed(const UpsampleInput& input, std::uint64_t seen, std::size_t block) {
    if (seen == 0 || input.rows_version == 0) return true;
    if (input.rows_version == seen) return false;
    return input.rows_version != seen + 1 || input.changed_rows[block] != 0;
}

} // namespace

void CheckedInput::check(const UpsampleInput& input, std::size_t motions, Workers& workers) {
    const std::size_t points = input.mover.size();
    require(input.positions.size() == 3 * points, "something that moves every point");
    require(input.normals.empty() || input.normals.size() == 3 * points, "a normal for every point, or none");
    if (points == 0) return;
    require(input.rows != nullptr, "points need influences");
    require(largest_of(input.mover, workers) < input.rows->size() + motions, "what moves a point exists");

    const std::size_t blocks = blocks_of_rows(input.rows->size());
    require(input.rows_version == 0 || input.changed_rows.size() == blocks, "a word on every block of rows");
    const std::uint64_t seen = past_largest_.size() == blocks ? version_ : 0;
    version_ = 0;
    past_largest_.resize(blocks);
    std::visit(
        [&]<typename Number>(const std::vector<SampleRow<Number>>& rows) {
            workers.for_each(blocks, grain / rows_in_block, [&](std::size_t block) {
                if (!changed(input, seen, block)) return;
                const std::size_t first = block * rows_in_block;
                past_largest_[block] = one_past_largest(
                    std::span(rows).subspan(first, std::min(rows_in_block, rows.size() - first)));
            });
        },
        input.rows->rows);
    require(blocks == 0 || std::ranges::max(past_largest_) <= motions, "every influence's motion exists");
    version_ = input.rows_version;
}

void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals) {
    require(motions.size() == motions_prepared, "a frame has as many motions as prepare() was told");
    require(positions.size() == input.positions.size(), "a place for every moved position");
    require(normals.size() == input.normals.size(), "a place for every moved normal");
}

} // namespace knead

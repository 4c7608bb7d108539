#include "upsample/checked_input.h"

#include "base/require.h"
#include "base/workers.h"
#include "graph/row_ends.h"

#include <algorithm>
#include <atomic>
#include <vector>

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

// One past the largest number in the rows, or 0.
Index end_of(const InfluenceRows& rows, Workers& workers) {
    std::vector<Index> ends(blocks_of_rows(rows.size()));
    find_row_ends(rows, std::vector<std::uint8_t>(ends.size(), 1), ends, workers);
    return ends.empty() ? 0 : std::ranges::max(ends);
}

} // namespace

void require_valid_input(const UpsampleInput& input, std::size_t motions, Workers& workers) {
    const std::size_t points = input.mover.size();
    require(input.positions.size() == 3 * points, "something that moves every point");
    require(input.normals.empty() || input.normals.size() == 3 * points, "a normal for every point, or none");
    if (points == 0) return;
    require(input.rows != nullptr, "points need influences");
    const std::size_t movers =
        input.mover_end ? *input.mover_end : std::size_t{largest_of(input.mover, workers)} + 1;
    require(movers <= input.rows->size() + motions, "what moves a point exists");
    require(input.places.size() <= std::min<std::size_t>(motions, input.rows->first_handle),
            "samples alone have places, and a motion each");
    const Index end = input.rows_end ? *input.rows_end : end_of(*input.rows, workers);
    require(end <= motions, "every influence's motion exists");
}

void require_motions(std::size_t motions_prepared, std::span<const Motion> motions) {
    require(motions.size() == motions_prepared, "a frame has as many motions as prepare() was told");
}

void require_valid_frame(const UpsampleInput& input, std::size_t motions_prepared,
                         std::span<const Motion> motions, std::span<float> positions,
                         std::span<float> normals) {
    require_motions(motions_prepared, motions);
    require(positions.size() == input.positions.size(), "a place for every moved position");
    require(normals.size() == input.normals.size(), "a place for every moved normal");
}

} // namespace knead

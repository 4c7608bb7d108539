#include "graph/row_ends.h"

#include "base/require.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <type_traits>

namespace knead {

namespace {

constexpr std::size_t grain = 256; // blocks

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

} // namespace

void find_row_ends(const InfluenceRows& nearest, std::span<const std::uint8_t> changed, std::span<Index> ends,
                   Workers& workers) {
    const std::size_t blocks = blocks_of_rows(nearest.size());
    require(changed.size() == blocks && ends.size() == blocks, "one a block of rows");
    std::visit(
        [&]<typename Number>(const std::vector<SampleRow<Number>>& rows) {
            workers.for_each(blocks, grain, [&](std::size_t block) {
                if (changed[block] == 0) return;
                const auto [begin, end] = rows_of_block(block, rows.size());
                ends[block] = one_past_largest(std::span(rows).subspan(begin, end - begin));
            });
        },
        nearest.rows);
}

} // namespace knead

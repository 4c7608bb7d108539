#include "graph/clouds.h"
#include "graph/row_ends.h"

#include <random>

namespace knead {
namespace {

using test::Machine;

TEST(RowEnds, AreOnePastTheLargestNumbers) {
    constexpr std::size_t count = 1000; // the last block is not full
    std::vector<NarrowRow> rows(count);
    std::mt19937 random(4);
    for (NarrowRow& row : rows) {
        row.sample.fill(NarrowRow::none);
        row.distance.fill(NarrowRow::none);
        const std::size_t samples = random() % 9;
        for (std::size_t k = 0; k < samples; ++k)
            row.sample.at(k) = static_cast<std::uint16_t>(random() % 65'535);
    }
    for (std::size_t v = 2 * rows_in_block; v < 3 * rows_in_block; ++v) rows[v].sample.fill(NarrowRow::none);
    InfluenceRows nearest;
    nearest.rows = rows;
    for (const bool wide : {false, true}) {
        if (wide) widen(nearest);
        Machine machine;
        std::vector<Index> ends(blocks_of_rows(count), 77);
        ASSERT_EQ(ends.size(), 4U);
        find_row_ends(nearest, std::vector<std::uint8_t>{1, 0, 1, 1}, ends, machine.workers);
        EXPECT_EQ(ends[1], 77U) << "nobody said that it changed";
        find_row_ends(nearest, std::vector<std::uint8_t>{0, 1, 0, 0}, ends, machine.workers);
        std::vector<Index> expected(ends.size(), 0);
        for (std::size_t v = 0; v < count; ++v)
            for (const std::uint16_t sample : rows[v].sample)
                if (sample != NarrowRow::none)
                    expected[v / rows_in_block] = std::max(expected[v / rows_in_block], Index{sample} + 1);
        EXPECT_EQ(ends, expected);
        EXPECT_EQ(ends[2], 0U);
    }
}

} // namespace
} // namespace knead

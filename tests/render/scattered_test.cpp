// The order in which the processor keeps the points of a chunk, and the subsets that it draws.

#include "render/scattered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace knead::test {

namespace {

constexpr std::size_t chunk = points_in_chunk;

// The places of the points of a part, ascending.
std::vector<std::size_t> places(const std::vector<std::uint16_t>& order, std::size_t part,
                                std::size_t parts) {
    std::vector<std::size_t> found;
    for (const std::uint16_t slot : slots_of_part(order, part, parts)) found.push_back(order[slot]);
    return found;
}

} // namespace

TEST(Scattered, EveryOrderHasEveryPointOnce) {
    for (const std::size_t points : {0U, 1U, 2U, 3U, 100U, 1000U, 1023U, 1024U}) {
        const std::vector<std::uint16_t> order = scattered_order(points);
        EXPECT_EQ(order.size(), points);
        EXPECT_EQ(std::set<std::uint16_t>(order.begin(), order.end()).size(), points);
        EXPECT_TRUE(std::ranges::all_of(order, [&](std::uint16_t place) { return place < points; }));
    }
}

TEST(Scattered, PartsAreTheChunkAndLieSideBySide) {
    for (const std::size_t points : {1U, 77U, 1024U})
        for (const std::size_t parts : {1U, 2U, 3U, 7U, 50U, 511U, 512U}) {
            const std::vector<std::uint16_t> order = scattered_order(points);
            std::vector<std::uint16_t> all;
            for (std::size_t part = 0; part < parts; ++part) {
                const std::vector<std::uint16_t> slots = slots_of_part(order, part, parts);
                if (slots.empty()) continue;
                EXPECT_EQ(std::ranges::max(slots) - std::ranges::min(slots) + 1U, slots.size());
                EXPECT_TRUE(std::ranges::is_sorted(places(order, part, parts)));
                all.insert(all.end(), slots.begin(), slots.end());
            }
            std::ranges::sort(all);
            EXPECT_EQ(all.size(), points);
            EXPECT_TRUE(std::ranges::adjacent_find(all) == all.end());
        }
}

TEST(Scattered, EveryPartIsSpreadEvenly) {
    const std::vector<std::uint16_t> order = scattered_order(chunk);
    for (const std::size_t parts : {2U, 3U, 5U, 8U, 20U, 50U, 100U})
        for (std::size_t part = 0; part < parts; ++part) {
            const std::vector<std::size_t> own = places(order, part, parts);
            const double even = static_cast<double>(chunk) / static_cast<double>(own.size());
            EXPECT_LE(static_cast<double>(own.front()), 3 * even);
            EXPECT_GE(static_cast<double>(own.back()), static_cast<double>(chunk) - 3 * even);
            for (std::size_t i = 1; i < own.size(); ++i)
                EXPECT_LE(static_cast<double>(own[i] - own[i - 1]), 3 * even) << part << " of " << parts;
        }
}

TEST(Scattered, ALargerFirstPartOnlyAddsPoints) {
    const std::vector<std::uint16_t> order = scattered_order(chunk);
    std::vector<std::size_t> before;
    for (std::size_t parts = 512; parts > 0; --parts) {
        const std::vector<std::size_t> now = places(order, 0, parts);
        EXPECT_TRUE(std::ranges::includes(now, before)) << parts;
        before = now;
    }
}

// However many subsets: every chunk's points are in one each.
TEST(Scattered, SubsetsShareOutAllPoints) {
    const std::vector<std::uint16_t> order = scattered_order(chunk);
    for (const std::size_t subsets : {1U, 2U, 50U, 512U, 513U, 700U, 1024U, 5000U}) {
        std::vector<std::size_t> drawn(12, 0);
        std::size_t first = 0;
        for (std::size_t subset = 0; subset < subsets; ++subset) {
            const PartOfChunk own = part_of_chunk(subset, subsets);
            ASSERT_LT(own.part, own.parts);
            for (std::size_t c = 0; c < drawn.size(); ++c) {
                if (c % own.step != own.rest) continue;
                drawn[c] += slots_of_part(order, own.part, own.parts).size();
                if (subset == 0) ++first;
            }
        }
        EXPECT_EQ(drawn, std::vector<std::size_t>(drawn.size(), chunk)) << subsets;
        EXPECT_GT(first, 0U) << "the first subset is never empty";
    }
}

} // namespace knead::test

#include "graph/kept_numbers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <random>

namespace knead {
namespace {

using Numbers = std::vector<Index>;

std::vector<Numbered> together(const Numbers& items, const Numbers& numbers) {
    std::vector<Numbered> result;
    for (std::size_t i = 0; i < items.size(); ++i) result.push_back({items[i], numbers[i]});
    return result;
}

void expect_numbers(const Numbers& numbers, std::size_t count, Index first, Index end) {
    ASSERT_EQ(numbers.size(), count);
    for (std::size_t i = 0; i < count; ++i) {
        ASSERT_GE(numbers[i], i == 0 ? first : numbers[i - 1] + 1);
        ASSERT_LT(numbers[i], end);
    }
}

TEST(KeptNumbers, AscendAndStay) {
    const Numbers items{70, 20, 50};
    const Numbers numbers = kept_numbers({}, items, 100, 1000);
    expect_numbers(numbers, 3, 100, 1000);
    EXPECT_EQ(kept_numbers(together(items, numbers), items, 100, 1000), numbers);
    EXPECT_EQ(kept_numbers(together(items, numbers), Numbers{70, 50}, 100, 1000),
              (Numbers{numbers[0], numbers[2]}));
    const Numbers more{1, 70, 2, 3, 20, 50, 4};
    const Numbers with_more = kept_numbers(together(items, numbers), more, 100, 1000);
    expect_numbers(with_more, 7, 100, 1000);
    EXPECT_EQ((Numbers{with_more[1], with_more[4], with_more[5]}), numbers);
}

TEST(KeptNumbers, StayForAllThatAreInOrderStill) {
    Numbers items(100);
    std::iota(items.begin(), items.end(), 0U);
    const std::vector<Numbered> before = together(items, kept_numbers({}, items, 0, 10'000));
    std::rotate(items.begin(), items.begin() + 5, items.end()); // the first five come last
    const Numbers numbers = kept_numbers(before, items, 0, 10'000);
    expect_numbers(numbers, 100, 0, 10'000);
    for (std::size_t i = 0; i < 95; ++i) EXPECT_EQ(numbers[i], before[i + 5].number);
}

TEST(KeptNumbers, AreSpreadAnewWhereThereIsNoRoom) {
    const std::vector<Numbered> before{{7, 10}, {8, 11}};
    const Numbers all = kept_numbers(before, Numbers{7, 1, 8}, 10, 13);
    EXPECT_EQ(all, (Numbers{10, 11, 12})) << "as many as there are";
    const Numbers last = kept_numbers(before, Numbers{7, 8, 1}, 10, 13);
    EXPECT_EQ(last, (Numbers{10, 11, 12}));
    EXPECT_EQ(kept_numbers(before, Numbers{}, 10, 13), Numbers{});
}

TEST(KeptNumbers, FollowAnyChanges) {
    std::mt19937 random(5);
    for (const Index end : {120U, 400U, 65'535U}) {
        Numbers items;
        std::vector<Numbered> before;
        std::size_t changed = 0, asked = 0;
        for (int step = 0; step < 300; ++step) {
            for (auto more = random() % 8; more > 0 && items.size() < 100; --more) {
                const Index item = static_cast<Index>(random() % 100'000);
                if (std::ranges::find(items, item) == items.end())
                    items.insert(items.begin() + static_cast<std::ptrdiff_t>(random() % (items.size() + 1)),
                                 item);
            }
            std::erase_if(items, [&](Index) { return random() % 25 == 0; });
            const Numbers numbers = kept_numbers(before, items, 20, end);
            expect_numbers(numbers, items.size(), 20, end);
            std::map<Index, Index> were;
            for (const Numbered& each : before) were[each.item] = each.number;
            for (std::size_t i = 0; i < items.size(); ++i)
                if (were.contains(items[i])) {
                    ++asked;
                    changed += were[items[i]] == numbers[i] ? 0 : 1;
                }
            before = together(items, numbers);
        }
        if (end == 65'535) {
            EXPECT_LT(5 * changed, asked);
        }
    }
}

} // namespace
} // namespace knead

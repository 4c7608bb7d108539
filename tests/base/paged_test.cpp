#include "base/paged.h"

#include <gtest/gtest.h>

#include <map>
#include <random>

namespace knead {

TEST(Paged, HoldsWhatWasSetAndElseTheFirstValue) {
    constexpr std::size_t count = 10'000;
    Paged<int> numbers(count, -1);
    std::map<std::size_t, int> expected;
    std::mt19937 random(1);
    for (int i = 0; i < 40; ++i) {
        const std::size_t at = random() % count;
        numbers.make_room(at);
        numbers.set(at, i);
        expected[at] = i;
    }
    for (std::size_t i = 0; i < count; ++i)
        ASSERT_EQ(numbers[i], expected.contains(i) ? expected[i] : -1) << i;
}

TEST(Paged, KeepsAPageThatHasRoom) {
    Paged<int> numbers(2, 0);
    numbers.make_room(0);
    numbers.set(0, 7);
    numbers.make_room(1);
    EXPECT_EQ(numbers[0], 7);
    EXPECT_EQ(numbers[1], 0);
}

} // namespace knead

#include "base/pile.h"

#include <gtest/gtest.h>

#include <random>
#include <set>

namespace knead {
namespace {

using Item = std::pair<int, std::array<int, 8>>; // some to a piece

std::multiset<int> items_of(const Pile<Item>& pile) {
    std::multiset<int> items;
    pile.each([&](const Item& item) { items.insert(item.first); });
    return items;
}

TEST(Pile, HoldsWhatWasPutOnItAndNotTakenOut) {
    std::mt19937 random(1);
    Pile<Item> pile;
    std::multiset<int> expected;
    for (int step = 0; step < 400; ++step) {
        for (auto more = random() % 60; more > 0; --more) {
            const auto number = static_cast<int>(random() % 1000);
            pile.push({number, {}});
            expected.insert(number);
        }
        if (random() % 2 == 0) {
            const auto every = static_cast<int>(1 + random() % 5); // with 1 all go
            const auto goes = [&](int number) { return number % every == 0; };
            std::multiset<int> asked;
            pile.erase_if([&](const Item& item) {
                asked.insert(item.first);
                return goes(item.first);
            });
            EXPECT_EQ(asked, expected) << "each is asked once";
            std::erase_if(expected, goes);
        }
        ASSERT_EQ(items_of(pile), expected);
        ASSERT_EQ(pile.empty(), expected.empty());
    }
}

TEST(Pile, FindsOne) {
    Pile<Item> pile;
    const auto is = [](int number) { return [=](const Item& item) { return item.first == number; }; };
    EXPECT_EQ(pile.find_if(is(0)), nullptr);
    for (int i = 0; i < 100; ++i) pile.push({i, {}});
    for (int i = 0; i < 100; ++i) EXPECT_EQ(pile.find_if(is(i))->first, i);
    EXPECT_EQ(pile.find_if(is(100)), nullptr);
}

TEST(Pile, HandsOverWhatItHolds) {
    Pile<Item> pile, other;
    for (int i = 0; i < 100; ++i) pile.push({i, {}});
    other.push({-1, {}});
    other = std::move(pile);
    EXPECT_EQ(items_of(other).size(), 100U);
    std::multiset<int> taken;
    other.take([&](const Item& item) { taken.insert(item.first); });
    EXPECT_EQ(taken.size(), 100U);
    EXPECT_TRUE(other.empty());
}

TEST(Pile, IsAsHighAsWanted) {
    Pile<Item> pile;
    for (int i = 0; i < 2'000'000; ++i) pile.push({i, {}});
    pile.clear();
    EXPECT_TRUE(pile.empty());
}

} // namespace
} // namespace knead

// Which of the things that history can make again stay.

#include "edit/keeping.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace knead {
namespace {

// What is left of a long history of which only a few places are kept.
std::vector<std::size_t> left_of(std::size_t steps, std::size_t kept) {
    std::vector<std::size_t> places;
    for (std::size_t step = 1; step <= steps; ++step) {
        places.push_back(step);
        if (places.size() > kept)
            places.erase(places.begin() + static_cast<std::ptrdiff_t>(least_missed(places, step, step)));
    }
    return places;
}

TEST(Keeping, GapsGrowWithTheDistance) {
    const std::vector<std::size_t> places = left_of(1000, 12);
    EXPECT_EQ(places.back(), 1000U);
    std::size_t after = 1001;
    for (auto place = places.rbegin(); place != places.rend(); ++place) {
        const std::size_t distance = 1000 - *place;
        EXPECT_LE(after - *place, distance + 3) << "at " << *place;
        after = *place;
    }
}

TEST(Keeping, WhatIsNeededStays) {
    const std::vector<std::size_t> places{3, 4};
    EXPECT_EQ(least_missed(places, 3, 90), 1U);
    EXPECT_EQ(least_missed(places, 4, 90), 0U);
}

// Going back step by step through all of history, where each step is made again from the nearest kept one
// before it.
TEST(Keeping, GoingBackThroughEverythingCostsAFewStepsEach) {
    constexpr std::size_t steps = 500, kept = 10;
    std::vector<std::size_t> places = left_of(steps, kept);
    std::size_t made = 0;
    for (std::size_t now = steps; now > 0; --now) {
        auto next = std::ranges::upper_bound(places, now);
        std::size_t from = next == places.begin() ? 0 : *(next - 1);
        for (++from; from <= now; ++from, ++made) {
            places.insert(std::ranges::lower_bound(places, from), from);
            if (places.size() > kept)
                places.erase(places.begin() + static_cast<std::ptrdiff_t>(least_missed(places, from, now)));
        }
    }
    EXPECT_LT(made, 12 * steps);
}

} // namespace
} // namespace knead

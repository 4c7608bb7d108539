// The rule behind an automatic number of samples.

#include "edit/sample_choice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <vector>

namespace knead::test {

namespace {

const std::vector<std::size_t> clouds{1,    2,    150,   700,   1000,   1001,      3999,      4000,
                                      8000, 9000, 20000, 79999, 200000, 1'000'000, 20'000'000};
const std::vector<double> frames{1e-5, 1e-3, 4e-3, 9e-3, 0.02, 0.05, 0.2, 3.0, 60.0};
const std::vector<HandleSpread> spreads{{0, 1, 1},       {2, 0.2, 0.4},     {2, 0.01, 0.2},
                                        {25, 0.01, 0.2}, {60, 0.001, 0.08}, {900, 1e-7, 0.01}};

SampleNeeds needs_of(std::size_t points, const HandleSpread& handles, double solving,
                     double upsampling = 0.004) {
    return {points, handles, FrameCost{2000, solving, upsampling}};
}

// As many as that comes to.
double count(const SampleChoice& choice, std::size_t points) {
    return choice.samples ? static_cast<double>(*choice.samples) : static_cast<double>(points);
}

template<typename Visit>
void for_all_needs(Visit&& visit) {
    for (const std::size_t points : clouds)
        for (const HandleSpread& handles : spreads)
            for (const double solving : frames) visit(points, handles, solving);
}

} // namespace

TEST(SampleChoice, IsARungOrEveryPointAndNeverMoreThanAFourthOfMany) {
    const std::set<std::uint64_t> rungs{200, 500, 1000, 2000, 5000, 10000, 20000};
    for_all_needs([&](std::size_t points, const HandleSpread& handles, double solving) {
        const SampleChoice choice = choose_samples(needs_of(points, handles, solving));
        EXPECT_EQ(choice.samples.has_value(), choice.reason != SampleReason::few_points);
        if (choice.samples) {
            EXPECT_TRUE(rungs.contains(*choice.samples)) << *choice.samples;
            EXPECT_LT(*choice.samples, points);
            EXPECT_TRUE(*choice.samples <= 1000 || 4 * *choice.samples <= points) << points;
        } else
            EXPECT_LE(points, 1000U);
    });
}

TEST(SampleChoice, MorePointsNeverMeanFewerSamples) {
    for (const HandleSpread& handles : spreads)
        for (const double solving : frames) {
            double before = 0;
            for (const std::size_t points : clouds) {
                const double now = count(choose_samples(needs_of(points, handles, solving)), points);
                EXPECT_GE(now, before) << points << " points, " << solving << " s";
                before = now;
            }
        }
}

TEST(SampleChoice, AFasterMachineNeverMeansFewerSamples) {
    for (const std::size_t points : clouds)
        for (const HandleSpread& handles : spreads) {
            double before = count(choose_samples({points, handles, {}}), points);
            for (const double solving : frames) {
                const double now = count(choose_samples(needs_of(points, handles, solving)), points);
                EXPECT_LE(now, before) << points << " points, " << solving << " s";
                EXPECT_GE(now, count(choose_samples(needs_of(points, handles, solving, 0.015)), points));
                before = now;
            }
        }
}

TEST(SampleChoice, HandlesThatAskForMoreNeverGetFewer) {
    for (const std::size_t points : clouds)
        for (const double solving : frames) {
            const auto with = [&](const HandleSpread& handles) {
                return count(choose_samples(needs_of(points, handles, solving)), points);
            };
            for (std::size_t handles = 1; handles < 1000; handles *= 3)
                EXPECT_LE(with({handles, 0.5, 0.5}), with({3 * handles, 0.5, 0.5}));
            for (const double part : {1.0, 0.3, 0.1, 0.03, 0.01, 1e-3, 1e-4, 1e-6}) {
                EXPECT_LE(with({2, part, 0.5}), with({2, part / 3, 0.5}));
                EXPECT_LE(with({2, 0.5, part}), with({2, 0.5, part / 3}));
            }
        }
}

TEST(SampleChoice, SaysWhatDecidedIt) {
    const HandleSpread plain{2, 0.2, 0.5}, close{2, 0.2, 0.09};
    EXPECT_EQ(choose_samples({900, plain, {}}), (SampleChoice{std::nullopt, SampleReason::few_points}));
    EXPECT_EQ(choose_samples({3000, plain, {}}), (SampleChoice{1000, SampleReason::points}));
    EXPECT_EQ(choose_samples({500'000, plain, {}}), (SampleChoice{2000, SampleReason::enough}));
    EXPECT_EQ(choose_samples({500'000, close, {}}), (SampleChoice{10000, SampleReason::handles}));
    EXPECT_EQ(choose_samples(needs_of(500'000, plain, 0.05)), (SampleChoice{500, SampleReason::machine}));
    EXPECT_EQ(choose_samples(needs_of(500'000, plain, 60)), (SampleChoice{200, SampleReason::machine}));
}

TEST(SampleChoice, AFrameOfWhatWasChosenTakesTwentyFiveMilliseconds) {
    for (const double solving : frames) {
        const SampleChoice choice = choose_samples(needs_of(10'000'000, {900, 1e-4, 0.01}, solving));
        const double times = std::pow(static_cast<double>(*choice.samples) / 2000, 1.15);
        EXPECT_TRUE(*choice.samples == 200 || solving * times + 0.004 < 0.0251);
        EXPECT_TRUE(*choice.samples == 20000 || solving * times * std::pow(2.5, 1.15) + 0.004 > 0.0249);
    }
}

// Measured again and again, a machine is never twice as fast; the number is not to tremble with it.
TEST(SampleChoice, StaysUnlessMuchSpeaksAgainstIt) {
    for_all_needs([&](std::size_t points, const HandleSpread& handles, double solving) {
        const SampleChoice first = choose_samples(needs_of(points, handles, solving));
        for (const double wobble : {0.8, 0.9, 1.0, 1.1, 1.25}) {
            const SampleNeeds again = needs_of(points, handles, solving * wobble);
            EXPECT_EQ(choose_samples_again(again, first.samples).samples, first.samples)
                << points << " points, " << solving << " s times " << wobble;
        }
        HandleSpread others = handles;
        others.smallest = std::min(1.0, 1.2 * others.smallest);
        others.closest = std::min(1.0, 1.1 * others.closest);
        EXPECT_EQ(choose_samples_again(needs_of(points, others, solving), first.samples).samples,
                  first.samples);
    });
}

TEST(SampleChoice, GoesWhereMuchDoesAndLeavesNumbersThatItWouldNotChoose) {
    const HandleSpread plain{2, 0.2, 0.5};
    EXPECT_EQ(choose_samples_again(needs_of(500'000, plain, 0.05), 2000).samples, 500U);
    EXPECT_EQ(choose_samples_again(needs_of(500'000, plain, 0.003), 500).samples, 2000U);
    EXPECT_EQ(choose_samples_again(needs_of(500'000, plain, 0.003), std::nullopt).samples, 2000U);
    EXPECT_EQ(choose_samples_again(needs_of(500'000, plain, 0.003), 2500).samples, 2000U);
    EXPECT_EQ(choose_samples_again(needs_of(900, plain, 0.003), 500).samples, std::nullopt);
}

TEST(SampleChoice, OneMachineIsFasterThanAnother) {
    const FrameCost usual{2000, 0.01, 0.004};
    EXPECT_TRUE(is_faster({2000, 0.008, 0.004}, usual));
    EXPECT_FALSE(is_faster(usual, usual));
    EXPECT_TRUE(is_faster({5000, 0.02, 0.004}, usual)) << "more samples in not as much more time";
    EXPECT_FALSE(is_faster({2000, 0.01, 0.02}, usual)) << "moving the points counts as well";
}

// What 50 samples wait for, a window that is drawn beside them above all, is not theirs.
TEST(SampleChoice, FewSamplesSayLittleOfMany) {
    const SampleNeeds after_few{36'000, {2, 0.2, 0.4}, FrameCost{50, 0.005, 0.001}};
    EXPECT_EQ(choose_samples_again(after_few, 50).samples, 2000U);
}

} // namespace knead::test

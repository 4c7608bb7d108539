#include "bench/statistics.h"

#include <gtest/gtest.h>

namespace {

using namespace knead;

TEST(Summary, IsAllZeroOfNothing) {
    const Summary summary = summarize({});
    EXPECT_EQ(summary.count, 0U);
    EXPECT_EQ(summary.median, 0);
    EXPECT_EQ(summary.lowest, 0);
    EXPECT_EQ(summary.highest, 0);
}

TEST(Summary, TakesTheMiddleOfAnOddNumber) {
    const Summary summary = summarize({5, 1, 100});
    EXPECT_EQ(summary.median, 5);
    EXPECT_EQ(summary.lowest, 1);
    EXPECT_EQ(summary.highest, 100);
    EXPECT_EQ(summary.count, 3U);
}

TEST(Summary, TakesTheMeanOfTheMiddleTwo) {
    EXPECT_EQ(summarize({4, 1, 3, 100}).median, 3.5);
}

TEST(Summary, OfOneValueIsThatValue) {
    const Summary summary = summarize({7});
    EXPECT_EQ(summary.median, 7);
    EXPECT_EQ(summary.lowest, 7);
    EXPECT_EQ(summary.highest, 7);
}

TEST(Summary, IsSoManyTimesAnotherByTheMedians) {
    EXPECT_EQ(ratio(summarize({3, 6, 100}), summarize({1, 2, 4})), 3);
    EXPECT_EQ(ratio(summarize({3}), summarize({})), 0);
}

TEST(Summary, IsNotMovedByOneSlowRun) {
    EXPECT_EQ(summarize({1, 1, 1, 1, 1000}).median, 1);
}

} // namespace

#include "bench/text_table.h"

#include <gtest/gtest.h>

namespace {

using namespace knead;

TEST(TextTable, AlignsTheFirstColumnLeftAndTheOthersRight) {
    EXPECT_EQ(format_table({{"name", "a", "long"}, {"x", "100", "2"}}), "name    a  long\n"
                                                                        "x     100     2\n");
}

TEST(TextTable, CountsCharactersNotBytes) {
    EXPECT_EQ(format_table({{"a", "10 µs"}, {"b", "–"}, {"c", "12345"}}), "a  10 µs\n"
                                                                          "b      –\n"
                                                                          "c  12345\n");
}

TEST(TextTable, LeavesLinesOfOneCellAsTheyAre) {
    EXPECT_EQ(format_table({{"a long heading"}, {"a", "1"}, {""}}), "a long heading\na  1\n\n");
}

TEST(TextTable, HasBlanksForMissingCellsButNoneAtTheEnd) {
    EXPECT_EQ(format_table({{"a", "b", "c"}, {"d", "e", ""}, {"f", "g"}}), "a  b  c\nd  e\nf  g\n");
}

TEST(TextTable, OfNothingIsEmpty) {
    EXPECT_EQ(format_table({}), "");
}

TEST(NumberText, GivesDurationsThreeDigits) {
    EXPECT_EQ(duration_text(390.2), "390 s");
    EXPECT_EQ(duration_text(1.034), "1.03 s");
    EXPECT_EQ(duration_text(0.0417), "41.7 ms");
    EXPECT_EQ(duration_text(0.002), "2.00 ms");
    EXPECT_EQ(duration_text(0.0001234), "123 µs");
    EXPECT_EQ(duration_text(0), "0 µs");
}

TEST(NumberText, GivesASpreadOneUnit) {
    EXPECT_EQ(spread_text({0.005, 0.0041, 0.0052, 3}), "4.10…5.20 ms");
    EXPECT_EQ(spread_text({0.005, 0.0005, 0.012, 3}), "500…12000 µs");
}

TEST(NumberText, GivesFactorsThreeDigits) {
    EXPECT_EQ(factor_text(0.5772), "0.58 ×");
    EXPECT_EQ(factor_text(8.654), "8.65 ×");
    EXPECT_EQ(factor_text(312.4), "312 ×");
    EXPECT_EQ(factor_text(2614.3), "2,614 ×");
}

TEST(NumberText, WritesZeroPlainly) {
    EXPECT_EQ(power_text(0), "0");
    EXPECT_EQ(power_text(2.34e-7), "2.3e-07");
}

} // namespace

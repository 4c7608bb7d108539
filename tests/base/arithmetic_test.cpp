#include "base/arithmetic.h"

#include <gtest/gtest.h>

namespace knead {
namespace {

void expect(std::string_view text, double value, std::string_view rest = "") {
    const auto sum = sum_of(text);
    ASSERT_TRUE(sum) << text;
    EXPECT_DOUBLE_EQ(sum->value, value) << text;
    EXPECT_EQ(sum->rest, rest) << text;
}

TEST(Arithmetic, DoesProductsFirst) {
    expect("12.5", 12.5);
    expect("10/4", 2.5);
    expect("2*3+4/8-1", 5.5);
    expect("-25+2", -23);
    expect(" 1 + 2 * 3 ", 7, " ");
    expect("8/2/2", 2);
    expect("2*-3", -6);
    expect("--2", 2);
    expect(".5*1e3", 500);
}

TEST(Arithmetic, LeavesWhatIsNotYetOrNoLongerANumber) {
    expect("10/", 10, "/");
    expect("10 mm", 10, " mm");
    expect("3-", 3, "-");
    expect("1+2x", 3, "x");
    for (const char* none : {"", "-", ".", "inf", "nan", "x1", "*2", "1/0", "1e999"})
        EXPECT_FALSE(sum_of(none)) << none;
}

} // namespace
} // namespace knead

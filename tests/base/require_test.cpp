#include "base/error.h"
#include "base/require.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

TEST(Require, says_where_a_promise_was_broken) {
    require(true, "holds");
    try {
        require(false, "two and two are four");
        FAIL();
    } catch (const BrokenInvariant& broken) {
        EXPECT_NE(std::string(broken.what()).find("require_test.cpp"), std::string::npos);
        EXPECT_NE(std::string(broken.what()).find("two and two"), std::string::npos);
    }
}

TEST(Error, names_the_place_where_there_is_one) {
    EXPECT_STREQ(Error(Trouble::input, "scan.ply:3", "is odd").what(), "scan.ply:3: is odd");
    EXPECT_STREQ(Error(Trouble::usage, "", "is odd").what(), "is odd");
}

} // namespace
} // namespace knead::test

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

TEST(Error, is_one_line_that_sends_no_commands_to_a_terminal) {
    const Error error(Trouble::input, "a\nb.ply", "the name \"\x1B[2J\x7F\xC2\x9B größe\" is taken");
    EXPECT_STREQ(error.what(), "a?b.ply: the name \"?[2J?? größe\" is taken");
}

} // namespace
} // namespace knead::test

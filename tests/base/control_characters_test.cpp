#include "base/control_characters.h"

#include <gtest/gtest.h>

namespace knead::test {
namespace {

TEST(WithoutControls, puts_one_question_mark_for_each) {
    EXPECT_EQ(without_controls(std::string_view("a\0b", 3)), "a?b");
    EXPECT_EQ(without_controls("\x1B[2J\x7F\t\n"), "?[2J???");
    EXPECT_EQ(without_controls("\xC2\x80 \xC2\x9B"
                               "31m \xC2\x9F"),
              "? ?31m ?")
        << "C1";
}

TEST(WithoutControls, leaves_everything_else) {
    for (const char* text : {"", "größe \xC2\xA0 µ €", "\xC2", "\xC3\x9B", "\xFF"})
        EXPECT_EQ(without_controls(text), text);
    EXPECT_EQ(without_controls("a\tb\nc\r", "\n\t"), "a\tb\nc?");
}

} // namespace
} // namespace knead::test

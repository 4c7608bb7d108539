#include "edit/kept_marks.h"

#include <gtest/gtest.h>

#include <random>

namespace knead {
namespace {

TEST(KeptMarks, ComeBackAndLeaveTheHandlesAlone) {
    std::mt19937 random(1);
    std::vector<std::uint8_t> marks(5000);
    for (std::size_t i = 0; i < marks.size(); ++i) // runs, and places where every point is another
        marks[i] = static_cast<std::uint8_t>(i < 3000 ? 64 * (i / 700) : random() & 0xffU);
    const KeptMarks kept(marks);
    std::vector<std::uint8_t> now(marks.size());
    for (std::uint8_t& mark : now) mark = static_cast<std::uint8_t>(random());
    const std::vector<std::uint8_t> before = now;
    kept.restore(now);
    for (std::size_t i = 0; i < marks.size(); ++i) {
        ASSERT_EQ(now[i] & marks_of_selection, marks[i] & marks_of_selection);
        ASSERT_EQ(now[i] & ~marks_of_selection, before[i] & ~marks_of_selection);
    }
    EXPECT_EQ(KeptMarks(now), kept);
    now[17] ^= mark_selected;
    EXPECT_NE(KeptMarks(now), kept);
    EXPECT_EQ(KeptMarks(std::vector<std::uint8_t>{}), KeptMarks());
}

} // namespace
} // namespace knead

#include "app/window_icon.h"

#include <gtest/gtest.h>

namespace knead::test {

TEST(WindowIcon, IsLargeEnoughForAListOfWindowsAndHasRoundCorners) {
    const WindowIcon icon = window_icon();
    ASSERT_GE(icon.size, 48);
    ASSERT_EQ(icon.rgba.size(), std::size_t{4} * static_cast<std::size_t>(icon.size * icon.size));
    const auto alpha = [&](int x, int y) {
        return icon.rgba[4 * static_cast<std::size_t>(y * icon.size + x) + 3];
    };
    EXPECT_EQ(alpha(0, 0), 0);
    EXPECT_EQ(alpha(icon.size - 1, icon.size - 1), 0);
    EXPECT_EQ(alpha(icon.size / 2, icon.size / 2), 255);
}

} // namespace knead::test

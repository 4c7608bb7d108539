#include "base/counts.h"

#include <gtest/gtest.h>

namespace knead {
namespace {

TEST(Counts, HaveTheirThousandsApart) {
    EXPECT_EQ(grouped(0), "0");
    EXPECT_EQ(grouped(999), "999");
    EXPECT_EQ(grouped(1000), "1,000");
    EXPECT_EQ(grouped(437645), "437,645");
    EXPECT_EQ(grouped(1000000), "1,000,000");
}

TEST(Counts, OfOneThingHaveNoS) {
    EXPECT_EQ(counted(0, "point"), "0 points");
    EXPECT_EQ(counted(1, "point"), "1 point");
    EXPECT_EQ(counted(12345, "sample"), "12,345 samples");
}

} // namespace
} // namespace knead

#include "base/memory.h"

#include <gtest/gtest.h>

#include <vector>

namespace {

using namespace knead;

TEST(Memory, ThePeakRemembersWhatIsGoneUntilItIsForgotten) {
    if (resident_memory() == 0 || !forget_peak_memory())
        GTEST_SKIP() << "this system does not tell how much memory a process holds, or keeps the peak";
    constexpr std::size_t size = std::size_t{256} << 20;
    const std::uint64_t before = resident_memory();
    {
        const std::vector<char> large(size, 1);
        EXPECT_GE(resident_memory(), before + size / 2) << large.back();
    }
    EXPECT_LT(resident_memory(), before + size / 2);
    EXPECT_GE(peak_memory(), before + size / 2);
    EXPECT_TRUE(forget_peak_memory());
    EXPECT_LT(peak_memory(), before + size / 2);
}

} // namespace

#include "base/large_pages.h"

#include "base/workers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace knead {
namespace {

// proc(5)'s flags of the mapping that an address lies in: "hg" where large pages were asked for.
std::string flags_of_mapping(const void* address) {
    const auto wanted = reinterpret_cast<std::uintptr_t>(address);
    std::ifstream maps("/proc/self/smaps");
    bool is_inside = false;
    for (std::string line; std::getline(maps, line);) {
        std::istringstream words(line);
        std::uintptr_t begin = 0, end = 0;
        char dash = 0;
        if (words >> std::hex >> begin >> dash >> end && dash == '-')
            is_inside = begin <= wanted && wanted < end;
        else if (is_inside && line.starts_with("VmFlags:"))
            return line + " ";
    }
    return {};
}

TEST(LargePages, AreAskedForWhereAnArrayIsLarge) {
    if (!std::filesystem::exists("/sys/kernel/mm/transparent_hugepage"))
        GTEST_SKIP() << "this kernel has no transparent huge pages";
    Workers workers(2);
    std::vector<float> large, small;
    resize_in_large_pages(large, std::size_t{8} << 20, workers);
    resize_in_large_pages(small, 1000, workers);
    EXPECT_NE(flags_of_mapping(large.data() + large.size() / 2).find(" hg "), std::string::npos);
    EXPECT_EQ(flags_of_mapping(small.data()).find(" hg "), std::string::npos);
}

TEST(LargePages, HoldWhatAnyResizedArrayHolds) {
    Workers workers(2);
    std::vector<std::uint16_t> array;
    for (const std::size_t count : {std::size_t{10}, std::size_t{5} << 20, std::size_t{3}, std::size_t{0}}) {
        resize_in_large_pages(array, count, workers);
        EXPECT_EQ(array.size(), count);
        EXPECT_TRUE(std::ranges::all_of(array, [](std::uint16_t value) { return value == 0; }));
    }
    array.assign(std::size_t{4} << 20, 7);
    resize_in_large_pages(array, 5, workers);
    EXPECT_EQ(array, std::vector<std::uint16_t>(5, 7)); // there was room
}

} // namespace
} // namespace knead

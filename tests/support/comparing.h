#pragma once
// What tests compare: words, and numbers to the last bit.

#include <gtest/gtest.h>

#include <algorithm>
#include <span>
#include <string>

namespace knead::test {

inline bool says(const std::string& words, const std::string& part) {
    return words.find(part) != std::string::npos;
}
#define EXPECT_SAYS(words, part) EXPECT_PRED2(::knead::test::says, words, part)

inline bool same_bits(std::span<const float> a, std::span<const float> b) {
    return std::ranges::equal(std::as_bytes(a), std::as_bytes(b));
}

} // namespace knead::test

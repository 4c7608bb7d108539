#include "io/lzf.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

namespace knead::test {
namespace {

using Bytes = std::vector<std::byte>;

Bytes bytes_of(std::initializer_list<int> values) {
    Bytes bytes;
    for (const int value : values) bytes.push_back(static_cast<std::byte>(value));
    return bytes;
}

Bytes bytes_of(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    return {bytes.begin(), bytes.end()};
}

// Of `size` letters from an alphabet of so many: the fewer, the more repeats.
Bytes random_bytes(std::size_t size, std::size_t letters, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    Bytes bytes(size);
    for (std::byte& byte : bytes) byte = static_cast<std::byte>(random() % letters);
    return bytes;
}

TEST(Lzf, UnpacksWhatTheFormatSays) {
    // Four letters as they are; then 4 (2 + 2) from 4 back; then 12 (3 + 9) from 1 back.
    const Bytes stream = bytes_of({0x03, 'a', 'b', 'c', 'd', 0x40, 0x03, 0xE0, 0x03, 0x00});
    Bytes to(20);
    ASSERT_TRUE(unpack_lzf(stream, to));
    EXPECT_EQ(to, bytes_of("abcdabcddddddddddddd"));
}

TEST(Lzf, GivesBackWhatItPacked) {
    for (const std::size_t letters : {1U, 2U, 5U, 40U, 256U})
        for (const std::size_t size : {0U, 1U, 2U, 3U, 31U, 32U, 33U, 264U, 265U, 8191U, 8195U, 100'000U}) {
            const Bytes bytes = random_bytes(size, letters, size + letters);
            const Bytes packed = pack_lzf(bytes);
            EXPECT_LE(packed.size(), size + (size + 31) / 32);
            EXPECT_LE(size, packed.size() * largest_lzf_expansion);
            Bytes back(size);
            EXPECT_TRUE(unpack_lzf(packed, back)) << letters << " letters, " << size;
            EXPECT_EQ(back, bytes);
        }
}

TEST(Lzf, MakesRepeatsShort) {
    const Bytes same(264 * 100, std::byte{7});
    EXPECT_LT(pack_lzf(same).size(), 400U);
    Bytes twice = random_bytes(8000, 256, 1);
    twice.insert(twice.end(), twice.begin(), twice.end());
    EXPECT_LT(pack_lzf(twice).size(), 8500U) << "repeats from as far back as the format reaches";
}

TEST(Lzf, RefusesStreamsThatAreNot) {
    Bytes to(20);
    for (const Bytes& stream :
         {bytes_of({0x05, 'a', 'b'}),  // six letters promised, two there
          bytes_of({0x00, 'a', 0x40}), // the end of the offset is missing
          bytes_of({0x00, 'a', 0xE0}), // and the length too
          bytes_of({0x00, 'a', 0xE0, 0x00}),
          bytes_of({0x00, 'a', 0x40, 0x01}),                               // from in front of the beginning
          bytes_of({0x40, 0x00}), bytes_of({0x00, 'a', 0xE0, 0xFF, 0x00}), // more than there is room for
          bytes_of({0x00, 'a'}),                                           // less
          bytes_of({})})
        EXPECT_FALSE(unpack_lzf(stream, to));
    EXPECT_TRUE(unpack_lzf({}, {}));
}

TEST(Lzf, NeverLeavesItsBuffers) {
    // Whatever the stream says; a sanitizer sees the rest.
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const Bytes stream = random_bytes(seed % 50, 256, seed);
        Bytes to(seed % 300);
        (void)unpack_lzf(stream, to);
    }
    const Bytes bytes = random_bytes(500, 3, 9);
    const Bytes packed = pack_lzf(bytes);
    for (std::size_t size = 0; size < packed.size(); ++size) {
        Bytes to(bytes.size());
        EXPECT_FALSE(unpack_lzf(std::span(packed).first(size), to)) << "cut at " << size;
    }
}

} // namespace
} // namespace knead::test

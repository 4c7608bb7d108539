#pragma once
// LZF, the compression of a PCD file's body: Marc Lehmann's LibLZF format, read and written from its
// description. A stream is a row of pieces, each told by the top three bits of its first byte:
//   000LLLLL                     L + 1 bytes follow as they are
//   LLLooooo oooooooo            L + 2 bytes, L = 1 … 6, of those already unpacked, from o + 1 back
//   111ooooo LLLLLLLL oooooooo   L + 9 bytes of them
// o has 13 bits, the high ones first. What is copied may reach into what is being written.

#include <cstddef>
#include <span>
#include <vector>

namespace knead {

// No stream unpacks to more than so many times its own size: three bytes make 264 at most.
constexpr std::size_t largest_lzf_expansion = 88;

// Unpacks a whole stream. Whether it is sound, and makes exactly as many bytes as `to` has; otherwise `to` is
// left with something in it.
bool unpack_lzf(std::span<const std::byte> packed, std::span<std::byte> to);

// A stream that unpacks to these bytes, by at most a thirty-second longer than they are, rounded up.
std::vector<std::byte> pack_lzf(std::span<const std::byte> bytes);

} // namespace knead

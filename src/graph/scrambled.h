#pragma once
// An order of numbers that follows no direction.

#include "base/types.h"

#include <cstdint>

namespace knead {

// What vertices or samples that are otherwise equal go by: their own numbers follow the Morton curve, and
// taking the lowest ones would favour one direction all over a lattice. Different for different numbers. (The
// finaliser of SplitMix64: G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number
// generators", 2014.)
inline std::uint64_t scrambled(Index number) {
    std::uint64_t z = (std::uint64_t{number} + 1) * 0x9e3779b97f4a7c15ULL;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
}

} // namespace knead

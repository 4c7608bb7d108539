#pragma once
// Orders of vertices or samples that follow no direction, and are the same on every run.

#include "base/types.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

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

// The same vertices in an order that depends on nothing but their numbers and follows no direction.
inline std::vector<Index> shuffled(std::vector<Index> vertices) {
    std::ranges::sort(vertices, {}, scrambled);
    return vertices;
}

// Sorts them, and shuffles each run of 1024: near vertices get near places, and where they are it still
// follows no direction.
inline void shuffle_in_runs(std::span<Index> vertices) {
    constexpr std::size_t run = 1024;
    std::ranges::sort(vertices);
    for (std::size_t first = 0; first < vertices.size(); first += run)
        std::ranges::sort(vertices.subspan(first, std::min(run, vertices.size() - first)), {}, scrambled);
}

} // namespace knead

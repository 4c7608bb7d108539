#pragma once
// Random numbers that depend on the seed and on what they are for, never on the order in which they are
// drawn: SplitMix64 (Steele, Lea, Flood: "Fast splittable pseudorandom number generators", OOPSLA 2014; the
// mixing constants are Stafford's variant 13), started anew for every point or ray.

#include "base/types.h"

#include <cmath>
#include <cstdint>
#include <numbers>

namespace knead {

// A bijection of 64-bit numbers that leaves no pattern.
constexpr std::uint64_t mix_bits(std::uint64_t bits) {
    bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9ULL;
    bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebULL;
    return bits ^ (bits >> 31);
}

// The sequence of one point, ray, row or stray.
struct Random {
    std::uint64_t state;

    // `purpose` tells apart what draws with the same seed and index.
    Random(std::uint64_t seed, std::uint64_t purpose, std::uint64_t index)
        : state(mix_bits(seed + mix_bits(index + mix_bits(purpose + 1)))) {}

    std::uint64_t bits() { return mix_bits(state += 0x9e3779b97f4a7c15ULL); }

    // Uniform in 0 ≤ x < 1.
    double uniform() { return static_cast<double>(bits() >> 11) * 0x1.0p-53; }

    double between(double low, double high) { return low + (high - low) * uniform(); }

    // Mean 0, standard deviation 1 (Box and Muller 1958).
    double gaussian() {
        const double radius = std::sqrt(-2 * std::log(1 - uniform()));
        return radius * std::cos(2 * std::numbers::pi * uniform());
    }

    // Uniform on the unit sphere (Archimedes: its height is uniform).
    Vec3d direction() {
        const double z = between(-1, 1);
        const double angle = between(0, 2 * std::numbers::pi);
        const double across = std::sqrt(1 - z * z);
        return {across * std::cos(angle), across * std::sin(angle), z};
    }
};

} // namespace knead

#pragma once
// Small LAS files of every kind, built by the tests that read and write them.

#include "io/through_files.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace knead::test {

struct ExtraBytes {
    std::string name;
    std::uint8_t type = 9; // as in the LAS specification: 9 is a float
    double scale = 0;      // 0: none
    double offset = 0;
    std::uint8_t undocumented = 0; // so many bytes, for type 0
};

struct LasKind {
    unsigned minor = 2;
    unsigned format = 0;
    std::vector<ExtraBytes> extra;
    std::size_t undescribed = 0; // bytes at the end of each point
    std::size_t records = 0;     // variable length records beside that of the extra bytes
    std::size_t extended = 0;    // behind the points; version 1.4
    std::size_t padding = 0;     // bytes before the first point
    std::array<double, 3> scale{0.01, 0.01, 0.01};
    std::array<double, 3> offset{0, 0, 0};
    std::size_t points = 5;
};

// Each point format in each version that has it, with and without records and extra bytes.
std::vector<LasKind> all_las_kinds();
std::string name_of(const LasKind& kind);

// Points with the numbers (100 + 7 i, -50 + i, 3 i²), an intensity of 1000 + i, return 1 of 2, classification
// i, and other bytes by a fixed pattern; extra bytes hold i and its multiples.
std::string las_sample(const LasKind& kind);
std::size_t las_length(const LasKind& kind); // of a point, in bytes
std::size_t las_points_begin(const LasKind& kind);

// Overwrites a little-endian scalar.
template<typename T>
void put(std::string& bytes, std::size_t at, T value) {
    bytes.replace(at, sizeof value, reinterpret_cast<const char*>(&value), sizeof value);
}
template<typename T>
T get(const std::string& bytes, std::size_t at) {
    T value{};
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
}

} // namespace knead::test

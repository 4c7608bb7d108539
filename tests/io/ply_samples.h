#pragma once
// Small PLY files of every kind, built by the tests that read and write them.

#include "io/ply_header.h"
#include "io/through_files.h"

#include <string>
#include <vector>

namespace knead::test {

struct SampleKind {
    PlyEncoding encoding = PlyEncoding::ascii;
    ScalarType coordinates = ScalarType::float32;
    bool lists = false;          // a list among the vertex properties, before z
    bool extra_elements = false; // one before and one after the vertices, the latter with lists
    std::string line_end = "\n"; // of the header, and of the rows of a text
};

// All encodings, each with all coordinate types, and with lists × other elements × line ends.
std::vector<SampleKind> all_sample_kinds();

// Five points at (10 + i, 20 - i, 30 + i % 2), with a uchar "red" of 7 i, normals (0, 0, 1) and, with lists,
// a list of i shorts i, i + 1, ...
constexpr std::size_t sample_points = 5;
std::string sample(const SampleKind& kind);

// For messages.
std::string name_of(const SampleKind& kind);

} // namespace knead::test

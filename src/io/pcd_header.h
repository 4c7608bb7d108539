#pragma once
// The header of a PCD file, versions 0.5 to 0.7: what a point is, how many there are, and where the body
// begins. After "The PCD (Point Cloud Data) file format" of the Point Cloud Library's documentation.

#include "cloud/point_cloud.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// More fields are refused, so that no line can make a file's memory grow out of proportion.
constexpr std::size_t most_pcd_fields = 10'000;

enum class PcdEncoding { ascii, binary, binary_compressed };

std::string_view name_of(PcdEncoding encoding); // as the DATA line has it

struct PcdField {
    std::string name;
    ScalarType type = ScalarType::float32;
    std::uint32_t count = 1; // numbers of a point, at least 1

    bool is_padding() const { return name == "_"; }
    std::size_t bytes() const { return size_of(type) * count; } // of a point
};

// The header lines that have a word for each field.
enum class PcdFieldLine { fields, size, type, count };

struct PcdHeader {
    PcdEncoding encoding = PcdEncoding::ascii;
    std::vector<PcdField> fields;
    std::uint32_t width = 0; // as promised; nobody has looked at the body yet
    std::uint32_t height = 0;
    std::uint64_t points = 0;      // width × height
    std::string viewpoint;         // its words, one blank between two; empty without the line
    std::size_t body = 0;          // the byte after the DATA line
    std::size_t bytes_a_point = 0; // of all fields
    std::size_t words_a_point = 0;

    // For each PcdFieldLine the byte behind its last word; nothing where there is no such line.
    std::array<std::optional<std::size_t>, 4> line_ends;

    bool is_organised() const { return height > 1; }
};

// Reads the header at the start of a file's bytes. Lines may come in any order before DATA; SIZE, TYPE and
// COUNT may be left out for 4-byte floats, one each, and so may one of WIDTH × HEIGHT and POINTS. `shown`
// names the file in errors. Throws Error (input) with file, line and cure.
PcdHeader parse_pcd_header(std::span<const std::byte> bytes, const std::string& shown);

// The letter of the TYPE line: "I", "U" or "F".
std::string_view pcd_letter_of(ScalarType type);

} // namespace knead

#pragma once
// The header of a PLY file: what its elements and their properties are, and where the body begins.

#include "cloud/point_cloud.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

enum class PlyEncoding { ascii, binary_little_endian, binary_big_endian };

std::string_view name_of(PlyEncoding encoding); // as the format line has it

struct PlyProperty {
    std::string name;
    ScalarType type = ScalarType::float32;
    bool is_list = false;
    ScalarType count_type = ScalarType::uint8; // of a list's length; an integer type
};

struct PlyElement {
    std::string name;
    std::uint64_t count = 0; // as promised; nobody has looked at the body yet
    std::vector<PlyProperty> properties;
    std::size_t line = 0; // of the header, from 1

    bool has_lists() const;
};

struct PlyHeader {
    PlyEncoding encoding = PlyEncoding::ascii;
    std::vector<PlyElement> elements;
    std::size_t body = 0; // the byte after the end_header line
};

// Reads the header at the start of a file's bytes. Lines may end in \n, \r\n, or, where the first one does,
// in a lone \r; blanks around words and empty lines do not matter. `shown` names the file in errors. Throws
// Error (input) with file, line and cure for anything that is not PLY 1.0.
PlyHeader parse_ply_header(std::span<const std::byte> bytes, const std::string& shown);

// A number type by either of its two spellings ("char" or "int8").
std::optional<ScalarType> ply_type(std::string_view name);

// The spelling that every PLY reader knows ("char" … "double"); PLY has no integers of 8 bytes, which are
// written as double.
std::string_view ply_name_of(ScalarType type);

} // namespace knead

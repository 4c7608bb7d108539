#pragma once
// More columns for the points of a LAS file: extra bytes, and their description in the header.

#include "io/cloud_file.h"
#include "io/las_header.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// An entry of 192 bytes that describes one value of a point.
std::vector<std::byte> las_descriptor(std::string_view name, ScalarType type);

// The header of a variable length record that describes extra bytes, for a content of `size` bytes.
std::vector<std::byte> las_extra_bytes_record(std::size_t size);

// `head` is all that a file has before its first point. Describes `added` columns in it, one float a point at
// the end of the points that there are, and moves what the header says of places behind. The points
// themselves are left to the caller. Throws Error (output) where the header cannot describe them.
void grow_las_head(std::vector<std::byte>& head, const LasHeader& header, std::span<const AddedColumn> added,
                   const std::string& shown);

} // namespace knead

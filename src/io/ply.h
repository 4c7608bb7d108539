#pragma once
// The PLY format: ascii, binary_little_endian and binary_big_endian, with lists and other elements.

#include "base/progress.h"
#include "base/whole_file.h"
#include "io/cloud_file.h"
#include "io/ply_header.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A PLY file as it was: all its bytes, and where its vertices lie. The rows are walked again when they are
// saved, so that no table of offsets is kept.
struct PlyImage final : SourceImage {
    std::vector<std::byte> bytes;
    PlyHeader header;
    std::size_t vertex_element = 0; // in header.elements
    std::size_t rows_begin = 0;     // the vertex rows are bytes[rows_begin … rows_end)
    std::size_t rows_end = 0;

    const PlyElement& vertices() const { return header.elements[vertex_element]; }

    std::string_view format() const override { return "ply"; }
    std::string_view encoding() const override { return name_of(header.encoding); }
    std::vector<std::string> besides_points() const override;
};

// Whether a file that begins with these bytes is a PLY file, good or bad.
bool looks_like_ply(std::span<const std::byte> first_bytes);

// The cloud in a file's bytes, which it keeps as its image. `shown` names the file in errors.
PointCloud read_ply(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

// See Format::write.
std::vector<std::string> write_ply(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress);

// The part of it that makes a new file of a cloud that came from no PLY file: binary_little_endian. Returns
// what it could not hold.
std::vector<std::string> write_new_ply(FileInTheMaking& file, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown, Progress& progress);

// Whether scalars of this encoding lie in the other byte order than this machine's.
bool is_swapped(PlyEncoding encoding);

} // namespace knead

#pragma once
// The LAS format of laser scans, versions 1.0 to 1.4 (ASPRS, "LAS Specification 1.4 - R15"), all point
// formats, 0 to 10, with extra bytes. LAZ, its compressed kind, is told by sight and refused.

#include "base/progress.h"
#include "base/whole_file.h"
#include "io/cloud_file.h"
#include "io/las_dimensions.h"
#include "io/las_header.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A LAS file as it was: all its bytes, and what its header says of them. The cloud's attributes are its
// dimensions, one for one.
struct LasImage final : SourceImage {
    std::vector<std::byte> bytes;
    LasHeader header;
    std::vector<LasDimension> dimensions;
    std::string version; // "1.4, point format 6"

    std::string_view format() const override { return "las"; }
    std::string_view encoding() const override { return version; }
    std::vector<std::string> besides_points() const override;
};

// Whether a file that begins with these bytes is a LAS or LAZ file, good or bad.
bool looks_like_las(std::span<const std::byte> first_bytes);

// The cloud in a file's bytes, which it keeps as its image. Coordinates are whole numbers times a scale plus
// an offset there, and float64 columns here. `shown` names the file in errors.
PointCloud read_las(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

// See Format::write. In a file that was LAS already, a coordinate that a pose changes becomes the whole
// number next to the posed value. Where the numbers of an axis would leave the range of 32 bits, its offset
// in the header changes, and its scale where the extent asks for coarser steps; all numbers of that axis are
// then made anew, which the returned sentences say. The header's bounds of an axis become those of the saved
// points where a number changed, and stay elsewhere. Normals of extra bytes turn, and added columns become
// extra bytes. A new file is LAS 1.2, or 1.4 where the attributes ask for it (las_plan.h).
std::vector<std::string> write_las(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress);

// The part of it that makes a new file of a cloud that came from no LAS file.
std::vector<std::string> write_new_las(FileInTheMaking& file, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown, Progress& progress);

} // namespace knead

#pragma once
// The PCD format of the Point Cloud Library: ascii, binary and binary_compressed, organised or not.
//
// A field of COUNT 1 is a column of the cloud under the field's name, one of a higher COUNT a list of so many
// numbers a point. The file keeps its own names where the cloud has others: normal_x, normal_y and normal_z
// are columns nx, ny and nz, unless the file has one of these as well; and the first 4-byte field "rgb" or
// "rgba", which packs 8-bit colours as 0xAARRGGBB, is the columns red, green, blue (and alpha for "rgba"),
// unless the file has one of these. Padding (fields called "_") is kept in the file and is no column.

#include "base/progress.h"
#include "base/whole_file.h"
#include "io/cloud_file.h"
#include "io/pcd_header.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// A PCD file as it was.
struct PcdImage final : SourceImage {
    std::vector<std::byte> bytes;
    PcdHeader header;
    // For each field its column in the cloud; nothing for padding and for packed colours.
    std::vector<std::optional<std::size_t>> columns;
    std::size_t body_end = 0; // what the header describes ends here

    std::string_view format() const override { return "pcd"; }
    std::string_view encoding() const override { return name_of(header.encoding); }
    std::vector<std::string> besides_points() const override;
};

// The two lengths in front of a binary_compressed body, and where its stream lies.
struct PcdCompressed {
    std::span<const std::byte> stream;
    std::size_t unpacked_size = 0;
};

// Throws Error (input) where the file does not hold it, or where it cannot unpack to what the header
// promises; nothing is allocated before that is known.
PcdCompressed find_pcd_stream(std::span<const std::byte> bytes, const PcdHeader& header,
                              const std::string& shown);

// The unpacked body: all numbers of the first field, then all of the second, ...
std::vector<std::byte> unpack_pcd_body(std::span<const std::byte> bytes, const PcdHeader& header,
                                       const std::string& shown);

// Whether a file that begins with these bytes is a PCD file, good or bad.
bool looks_like_pcd(std::span<const std::byte> first_bytes);

// The cloud in a file's bytes, which it keeps as its image. `shown` names the file in errors.
PointCloud read_pcd(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

// See Format::write. A binary_compressed file in which anything changes is compressed anew.
std::vector<std::string> write_pcd(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress);

// The part of it that makes a new file of a cloud that came from no PCD file: binary, unorganised, with
// normals called normal_x …, and colours of bytes packed into one field. Returns what it could not hold.
std::vector<std::string> write_new_pcd(FileInTheMaking& file, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown, Progress& progress);

} // namespace knead

#pragma once
// The OFF format (geomview's manual, "OFF: object file format"): its vertices are the points. Faces are kept
// byte for byte: they name vertices by number, and vertices keep their order.
//
// The keyword [ST][C][N]OFF says what a vertex has: x y z, then, for N, the normal (columns nx ny nz), for C,
// the colour (red green blue and, where there is a fourth number, alpha: uint8 where all are whole and one is
// larger than 1, else float32), for ST, the texture coordinates (s t). Numbers behind those are kept and not
// understood. A vertex is a line, and a face, too. Binary OFF, and vertices of other than three coordinates
// (4OFF, nOFF), are refused. The keyword may be left out in a file with the extension, which is then all that
// tells it from a table.

#include "base/whole_file.h"
#include "cloud/point_cloud.h"
#include "io/cloud_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// An OFF file as it was. Its rows are walked again when it is saved.
struct OffImage final : SourceImage {
    std::vector<std::byte> bytes;
    std::size_t points = 0;
    std::size_t faces = 0;
    std::size_t rows_begin = 0; // where the first vertex row is, or what is before it

    std::string_view format() const override { return "off"; }
    std::string_view encoding() const override { return "ascii"; }
    std::vector<std::string> besides_points() const override;
};

// Whether a file that begins with these bytes is an OFF file, good or bad, and says so.
bool looks_like_off(std::span<const std::byte> first_bytes);
// Whether it begins with numbers, as one without its keyword does; so does many a table.
bool looks_like_bare_off(std::span<const std::byte> first_bytes);

// The cloud in a file's bytes, which it keeps as its image. `shown` names the file in errors. Throws Error
// (input) for counts that the file does not hold, a number that is none, and a face that names what is not
// there.
PointCloud read_off(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

// See Format::write. A new file has normals and colours (bytes as bytes, others as fractions) where the cloud
// has them, and no faces.
std::vector<std::string> write_off(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress);

} // namespace knead

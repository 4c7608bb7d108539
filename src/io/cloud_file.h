#pragma once
// Point clouds from and to files, whatever the format. A file to read is told by its content first and by its
// extension second, a file to write by its extension; the table is in formats.cpp, and each format has files
// of its own.

#include "base/progress.h"
#include "base/whole_file.h"
#include "cloud/point_cloud.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// Reads a cloud with every attribute. Throws Error (input) that names the file, the place in it, and the
// cure.
PointCloud read_cloud(const std::filesystem::path& path, Progress& progress);

// A column to save behind those of the cloud, as float32: one value a point, in the order of the file. A name
// that the cloud has already gets a number. Formats that have no place for it say so.
struct AddedColumn {
    std::string name; // one word
    std::span<const float> values;
};

// The shape to save, in the order of the file; the spans are only read during the call.
struct PosedShape {
    std::span<const float> positions; // 3n, relative to cloud.origin, as cloud.positions; empty: as they were
    std::span<const float> normals;   // 3n, as read_normals() gives them; empty: as they were
    std::vector<AddedColumn> added = {};
    // How each point turned: 4n, w x y z, unit quaternions; empty: not at all. Gaussian splats
    // (cloud/splats.h) turn with it, their view-dependent colours included, and keep their sizes. Other
    // clouds have no use for it.
    std::span<const float> rotations = {};
};

// Writes the cloud in a posed shape: same points, order and attributes, in the format of the target's
// extension. A coordinate is saved as the file's own value plus the displacement, posed - rest in double,
// rounded once to the column's type; one that did not move keeps its bytes (its very text in a text file),
// and so does a normal or a splat that did not turn. Where the cloud came from a file of the target's format,
// types and encoding stay, and everything else of that file stays as it was, byte for byte; a cloud from
// elsewhere is written as a new file of the target's format (PLY: binary_little_endian). Returns what the
// target does not hold as the cloud had it, and what else the user should hear, one sentence each that begins
// with the target's name; usually none. The target is replaced whole or not at all. Throws Error (output)
// when it cannot be written, when its extension names a format that knead does not write, or when a
// coordinate no longer fits its column's type; Cancelled when told so.
std::vector<std::string> write_cloud(const std::filesystem::path& path, const PointCloud& cloud,
                                     const PosedShape& shape, Progress& progress);

// The same into a file that the caller commits, in the format of that target's extension.
std::vector<std::string> write_cloud(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                     Progress& progress);

// The same without some of the points: always a new file of the target's format, with nothing of what the
// cloud's own file held besides its points (faces, say), which is told. `left_out`: one a point, 0 where it
// is written; at least one is, or Error (output) says so.
std::vector<std::string> write_part(const std::filesystem::path& path, const PointCloud& cloud,
                                    const PosedShape& shape, std::span<const std::uint8_t> left_out,
                                    Progress& progress);

// Whether knead reads and writes files with this extension.
bool has_cloud_extension(const std::filesystem::path& path);

// The same extensions for a message: ".ply, .las".
std::string known_extensions();

// Throws what write_cloud() would for a target of the wrong extension or in a folder that cannot be written
// to, so that one who computes for long can ask beforehand. Nothing is left behind.
void refuse_bad_target(const std::filesystem::path& path);

// The names of the format and the encoding of the file that the cloud was read from ("ply", "ascii"), which
// saving in that format keeps; or of the new PLY file that a cloud from nowhere becomes. They are good as
// long as the cloud.
struct FileKind {
    std::string_view format;
    std::string_view encoding;
};
FileKind file_kind(const PointCloud& cloud);

} // namespace knead

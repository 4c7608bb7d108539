#pragma once
// The Wavefront OBJ format (appendix B1 of the Advanced Visualizer manual, "Object Files"): its vertices are
// the points. Faces, lines, materials, groups and all else are kept byte for byte: they name vertices by
// number, and vertices keep their order.
//
// - v x y z: a point; with a fourth number its weight, a column "weight" that changes nothing.
// - v x y z r g b: with a colour, as many programs write it: columns red, green and blue of floats
//   as written, usually from 0 to 1. Seven numbers are x y z weight r g b; of five, or more than seven, those
//   behind x y z are kept and not understood. A point without a weight or colour gets 1 where others have
//   one.
// - vn x y z: normals: columns nx, ny and nz where each belongs to one point alone. That is so if the corners
//   that name a point all name one normal, which no other point's do (a point of no corner gets 0 0 0); and
//   where there are as many normals as points and every corner that names a point names the normal of the
//   same number, each belongs to the point of its number. Other normals are kept as they are, with a remark.
// - f, fo, l, p: numbers are checked: a point, a texture coordinate or a normal that is not in the file is an
//   error.

#include "base/whole_file.h"
#include "cloud/point_cloud.h"
#include "io/cloud_file.h"

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace knead {

// How many statements of each kind a file has.
struct ObjCounts {
    std::size_t points = 0;              // v
    std::size_t texture_coordinates = 0; // vt
    std::size_t normals = 0;             // vn
    std::size_t faces = 0, lines = 0, point_elements = 0;
};

// An OBJ file as it was. Its statements are walked again when it is saved.
struct ObjImage final : SourceImage {
    std::vector<std::byte> bytes;
    ObjCounts counts;
    // Which point each normal of the file belongs to; no_index for one that is left as it is.
    std::vector<Index> point_of_normal;
    bool has_normals = false; // whether normals are columns of the cloud

    std::string_view format() const override { return "obj"; }
    std::string_view encoding() const override { return "ascii"; }
    std::vector<std::string> besides_points() const override;
};

// Whether the first statement in these bytes is one of OBJ.
bool looks_like_obj(std::span<const std::byte> first_bytes);

// The cloud in a file's bytes, which it keeps as its image. `shown` names the file in errors. Throws Error
// (input) for a file without vertices, a number that is none, and an element that names what is not there.
PointCloud read_obj(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

// See Format::write. A new file has a `v` a point, with its colour as fractions where the cloud has colours,
// and then the normals, where it has them. A cloud of no points is refused, since no OBJ file can tell of it.
std::vector<std::string> write_obj(FileInTheMaking& file, const PointCloud& cloud, const PosedShape& shape,
                                   const std::string& shown, Progress& progress);

} // namespace knead

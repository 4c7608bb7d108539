#pragma once
// Tables of numbers: .xyz, .txt, .asc, .csv and .pts, one point a line, one number a column.
//
// Columns are parted by blanks and tabs, by commas, or by semicolons, as the first row has it; where it is
// not by commas, "1,5" is one and a half, unless a number has a decimal point. Lines may end in \n, \r\n or a
// lone \r; a byte-order mark, empty lines, and remarks (# or //) are passed over. A line of names in front of
// the rows, quoted or not, or a remark that names as many columns, x, y and z among them, names the columns.
// A line with a whole number alone in front of the rows is a count of points, as PTS has it; fewer rows are
// refused, more are read with a remark.
//
// Columns with no names are x y z, and then, told by their values, colours (whole, 0 … 255), normals (of
// length 1), an intensity in front of colours or alone in a .pts file, or column_4 and so on. Common names
// are given the spelling that the rest of knead knows: x y z, nx ny nz, red green blue alpha, intensity. All
// columns are float64, but for whole colours, which are uint8 or uint16.

#include "base/progress.h"
#include "base/whole_file.h"
#include "io/cloud_file.h"
#include "io/table_layout.h"

#include <cstddef>
#include <string>
#include <vector>

namespace knead {

// The customs of the extensions: what separates the columns of a new file, and what comes first.
enum class TableKind {
    xyz, // blanks; a remark names the columns where their numbers would not tell the same names
    txt, // the same; also .asc, and a table under any other name
    csv, // commas, and a line of names
    pts, // a count first; x y z, intensity and colours alone
};

std::string_view name_of(TableKind kind); // "xyz" …

// A table as it was: all its bytes. The rows are walked again when they are saved.
struct TableImage final : SourceImage {
    std::vector<std::byte> bytes;
    TableLayout layout;
    TableKind kind = TableKind::txt;

    std::string_view format() const override { return name_of(kind); }
    std::string_view encoding() const override;
};

// The cloud in a file's bytes, which it keeps as its image. `shown` names the file in errors, and its
// extension the kind.
PointCloud read_table(std::vector<std::byte> bytes, const std::string& shown, Progress& progress);

// See Format::write. A table of the same kind is patched: only numbers that changed get another text, the
// shortest that reads back as the number. Of another kind, or from elsewhere, it is written anew.
std::vector<std::string> write_table(TableKind kind, FileInTheMaking& file, const PointCloud& cloud,
                                     const PosedShape& shape, const std::string& shown, Progress& progress);

// The part of them that makes a new file. Returns what it could not hold.
std::vector<std::string> write_new_table(FileInTheMaking& file, TableKind kind, const PointCloud& cloud,
                                         const PosedShape& shape, const std::string& shown,
                                         Progress& progress);

} // namespace knead

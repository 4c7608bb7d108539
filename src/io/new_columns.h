#pragma once
// What a new file of any format holds: the columns of a cloud, posed, and the added ones behind them.

#include "io/posed_values.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// The added columns under names that the cloud does not have: "stretch_2" where there is a "stretch".
std::vector<AddedColumn> with_free_names(const PointCloud& cloud, std::vector<AddedColumn> added);

// One column of a new file. It points into the cloud, the shape and the vectors that it was made from.
struct NewColumn {
    std::string name; // the cloud's own; a format that cannot write it says and writes another
    ScalarType type = ScalarType::float32;
    const Attribute* attribute = nullptr; // of the cloud; null for an added column
    const PosedColumn* posed = nullptr;   // how a pose changes it; null where it does not
    const float* added = nullptr;         // the values of an added column, one a point

    bool is_list() const { return attribute != nullptr && attribute->is_list(); }
};

// All columns that a new file may hold, in the order of the cloud, added ones last, under names that the
// cloud does not have. Coordinates of a whole type of up to 4 bytes that a pose changes get one with
// fractions. To be moved, not copied, since `columns` points into the others.
struct ColumnsToWrite {
    std::vector<PosedColumn> posed;
    std::vector<AddedColumn> added;
    std::vector<NewColumn> columns;

    ColumnsToWrite() = default;
    ColumnsToWrite(ColumnsToWrite&&) = default;
    ColumnsToWrite& operator=(ColumnsToWrite&&) = default;
};

// They point into the cloud and the shape, too.
ColumnsToWrite columns_to_write(const PointCloud& cloud, const PosedShape& shape);

// Calls the coordinates x, y and z, and the normals, where there are some, by the format's own names.
void name_standard_columns(std::vector<NewColumn>& columns, const PointCloud& cloud,
                           const std::array<std::string_view, 3>& normals);

// Makes the names such that a format can write them: letters that `is_legal` refuses become '_', longer names
// than `longest`, in bytes, are cut, and a name that is then taken gets a number. Returns a sentence for each
// that changed.
std::vector<std::string> make_names_legal(std::vector<NewColumn>& columns, bool (*is_legal)(char letter),
                                          std::size_t longest = 1000);

// Columns as the subject of a sentence: "the columns 'a', 'b' and 12 more are". At least one.
std::string columns_are(const std::vector<std::string>& names);

// Whether a letter may stand in a name that is one word of a text.
bool is_word_letter(char letter);

// How many numbers each list of a column has; nothing where that differs. 0 where there are no points.
std::optional<std::uint64_t> common_length(const Attribute& list);

// The scalar to write for point i, in native byte order: the posed value, or the very bytes of the cloud's
// column. Not for lists. `shown` names the target in errors.
std::array<std::byte, 8> new_scalar(const NewColumn& column, std::size_t i, const std::string& shown);

// The same as double, exact as value_at() is.
double new_value(const NewColumn& column, std::size_t i, const std::string& shown);

// Prints the value of point i, or the one at a place in its list, into 64 characters at least: the shortest
// text that reads back as the value, whatever its type; what a pose turned is computed as floats and has no
// more digits than they. How many characters it took.
std::size_t print_new_value(const NewColumn& column, std::size_t i, const std::string& shown,
                            std::span<char> to, std::uint64_t place = 0);

} // namespace knead

#pragma once
// What a new file of any format holds: the columns of a cloud, posed, and the added ones behind them.

#include "io/posed_values.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
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

// All columns to write, in the order of the cloud, added ones last. `posed` is posed_columns(cloud, shape).
std::vector<NewColumn> new_columns(const PointCloud& cloud, const std::vector<PosedColumn>& posed,
                                   const std::vector<AddedColumn>& added);

// Calls the coordinates x, y and z, and the normals, where there are some, by the format's own names.
void name_standard_columns(std::vector<NewColumn>& columns, const PointCloud& cloud,
                           const std::array<std::string_view, 3>& normals);

// Makes the names such that a format can write them: letters that `is_legal` refuses become '_', longer names
// than `longest` are cut, and a name that is then taken gets a number. Returns a sentence for each that
// changed.
std::vector<std::string> make_names_legal(std::vector<NewColumn>& columns, bool (*is_legal)(char letter),
                                          std::size_t longest);

// Whether a letter may stand in a name that is one word of a text.
bool is_word_letter(char letter);

// How many numbers each list of a column has; nothing where that differs. 0 where there are no points.
std::optional<std::uint64_t> common_length(const Attribute& list);

// The scalar to write for point i, in native byte order: the posed value, or the very bytes of the cloud's
// column. Not for lists. `shown` names the target in errors.
std::array<std::byte, 8> new_scalar(const NewColumn& column, std::size_t i, const std::string& shown);

// The same as double, exact as value_at() is.
double new_value(const NewColumn& column, std::size_t i, const std::string& shown);

} // namespace knead

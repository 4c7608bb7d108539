#pragma once
// How a table of numbers is written: what parts its columns, which line names them, where its rows begin.
// There is no standard of it; what is understood is in table.h.

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

// More columns are refused, so that no line can make a file's memory grow out of proportion.
constexpr std::size_t most_table_columns = 10'000;

struct TableLayout {
    char separator = ' ';       // between columns: ',' or ';', or ' ' for any blanks and tabs
    char blank = ' ';           // with ' ' as separator, what new columns are parted by: ' ' or '\t'
    bool decimal_comma = false; // "1,5"; not with ',' as separator
    std::size_t columns = 3;

    std::vector<std::string> names; // of all columns as the file has them, without quotes; empty: none
    std::size_t names_end = 0;      // the byte behind the last name
    char names_separator = ' ';     // between them: ',', ';', ' ' or '\t'
    bool has_quoted_names = false;
    // Of a remark with x, y and z in it that names no columns, since there are not as many; 0: no such
    // remark.
    std::size_t words_in_remark = 0;

    bool has_count = false;     // a line with the number of points comes first
    std::size_t rows_begin = 0; // the first byte of a count, or of the first row; the file's size if none
};

// Looks at a table up to its first row. `shown` names the file in errors. Throws Error (input) with file,
// line and cure for what is no table with at least x, y and z.
TableLayout find_table_layout(std::span<const std::byte> bytes, const std::string& shown);

// Whether a file that begins with these bytes is a table for all that can be seen of it.
bool looks_like_table(std::span<const std::byte> first_bytes);

// The axis (0, 1, 2) that a column's name tells, "X" or "z" or "Points:1"; nothing for other names.
std::optional<std::size_t> axis_of(std::string_view name);

} // namespace knead

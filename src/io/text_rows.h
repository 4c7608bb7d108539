#pragma once
// The rows of a text with a header, as ascii PLY and ascii PCD have them: one row a line, with a number for
// each column. Readers only.

#include "cloud/point_cloud.h"
#include "io/text_cursor.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace knead {

// What a format calls its rows and columns, for messages.
struct RowWords {
    std::string row;     // "point", "vertex row"
    std::string rows;    // "points", "rows"
    std::string column;  // "field", "property"
    std::string columns; // "fields", "properties"
};

// A cursor over the numbers, and the words for what is wrong with them: whatever is not as it should be
// throws Error (input) with the file, the line and the cure.
class TextRows {
public:
    // From the byte `at` on. `bytes` and `shown`, the file's name for errors, must outlive it.
    TextRows(std::span<const std::byte> bytes, std::size_t at, const std::string& shown, RowWords words);

    // To the row of this number, from 0, which is there; the header promises so many.
    void begin(std::uint64_t row, std::uint64_t promised);

    // The next number of the row, of the column of this name and type, to `to` in native byte order.
    void number(const std::string& column, ScalarType type, std::byte* to);

    // The next number as the length of a list; at least 0.
    std::uint64_t list_length(const std::string& column);

    // Over the next number, whatever it is.
    void pass_over(const std::string& column);

    // Whether the row has one more word; it stays the next one.
    bool has_word() { return find_word(text_); }

    // Behind the last number of a row: nothing may be left in its line.
    void end();

    // The byte behind what was read.
    std::size_t at() const;

private:
    void to_word(const std::string& column);
    std::string word() const;
    [[noreturn]] void fail(const std::string& words) const;

    std::span<const std::byte> bytes_;
    const std::string& shown_;
    RowWords words_;
    TextCursor text_;
    std::uint64_t row_ = 0;
};

} // namespace knead

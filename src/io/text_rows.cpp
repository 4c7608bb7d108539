#include "io/text_rows.h"

#include "io/text_numbers.h"

#include <array>
#include <cstring>
#include <utility>

namespace knead {

TextRows::TextRows(std::span<const std::byte> bytes, std::size_t at, const std::string& shown, RowWords words)
    : bytes_(bytes), shown_(shown), words_(std::move(words)) {
    const char* const text = reinterpret_cast<const char*>(bytes.data());
    text_ = {text + at, text + bytes.size()};
}

void TextRows::begin(std::uint64_t row, std::uint64_t promised) {
    row_ = row;
    if (!find_row(text_))
        fail("is missing: the file ends before it, though the header promises " + std::to_string(promised) +
             " " + words_.rows + "; the file is cut off or its header lies, get it again from its source");
}

void TextRows::number(const std::string& column, ScalarType type, std::byte* to) {
    to_word(column);
    if (!parse_scalar(text_, type, to))
        fail("has " + word() + " for the " + words_.column + " " + in_quotes(column) + ", which is no " +
             std::string(name_of(type)) + "; correct the value or the " + words_.column + "'s type");
}

std::uint64_t TextRows::list_length(const std::string& column) {
    to_word(column);
    TextCursor ahead = text_; // a message is to name this word
    std::int64_t length = -1;
    std::array<std::byte, sizeof length> bytes{};
    if (parse_scalar(ahead, ScalarType::int64, bytes.data()))
        std::memcpy(&length, bytes.data(), sizeof length);
    if (length < 0)
        fail("has a list " + in_quotes(column) + " of the length " + word() + "; correct the row");
    text_ = ahead;
    return static_cast<std::uint64_t>(length);
}

void TextRows::pass_over(const std::string& column) {
    to_word(column);
    text_.at = word_end(text_);
}

void TextRows::end() {
    if (find_word(text_))
        fail("has more numbers than the header has " + words_.columns + ", from " + word() +
             " on; correct the row or the header");
}

std::size_t TextRows::at() const {
    return static_cast<std::size_t>(text_.at - reinterpret_cast<const char*>(bytes_.data()));
}

void TextRows::to_word(const std::string& column) {
    if (!find_word(text_))
        fail("ends before the " + words_.column + " " + in_quotes(column) +
             "; a row is one line with a number for each " + words_.column);
}

std::string TextRows::word() const {
    return in_quotes(word_at(text_));
}

void TextRows::fail(const std::string& words) const {
    fail_at(bytes_, at(), shown_, words_.row + " " + std::to_string(row_) + " " + words);
}

} // namespace knead

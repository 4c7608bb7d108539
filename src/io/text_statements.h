#pragma once
// Lines of words with comments, as OBJ and OFF files have them, for their readers and writers.

#include "io/text_cursor.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace knead {

// A statement is a line; a backslash at the end of a line joins the next one to it. A word that begins with #
// ends it: what follows is a comment to the end of the line. Empty lines, comments, and a byte-order mark in
// front of it all are passed over. Words are views of the bytes, so they tell their place.
class TextStatements {
public:
    // `bytes` must outlive it.
    explicit TextStatements(std::span<const std::byte> bytes);

    // On to the next statement that has a word; whether there is one. What is left of the one before is
    // passed over.
    bool next();

    // The statement's first word.
    std::string_view keyword() const { return keyword_; }

    // The next word of this statement; nothing at its end.
    std::optional<std::string_view> word();

    // Where it has got to, as a place in the bytes.
    std::size_t at() const { return static_cast<std::size_t>(text_.at - begin_); }

private:
    bool at_continuation(const char* at) const;
    void pass_line_end();

    const char* begin_;
    TextCursor text_;
    std::string_view keyword_;
    bool begun_ = false; // whether there is a statement, of which a rest may be left
};

// A text that statements come from, for what its words say. Both must outlive it.
struct StatementSource {
    std::span<const std::byte> bytes;
    const std::string& shown; // the file's name, for errors

    // The number that a word of the text is. Throws as fail() where it is none.
    double number(std::string_view word) const;
    float float_number(std::string_view word) const;

    // Throws Error (input) for the word's line, with the word in front of these: "'five' is no number".
    [[noreturn]] void fail(std::string_view word, const std::string& words) const;
};

} // namespace knead

#pragma once
// Words and rows of text, as ascii PLY has them: one row a line, empty lines between rows passed over.

#include <string_view>

namespace knead {

struct TextCursor {
    const char* at = nullptr;
    const char* end = nullptr;
};

inline bool is_blank(char letter) {
    return letter == ' ' || letter == '\t' || letter == '\v' || letter == '\f';
}

inline bool is_line_end(char letter) {
    return letter == '\n' || letter == '\r';
}

// To the next word of this line; whether there is one.
inline bool find_word(TextCursor& text) {
    while (text.at != text.end && is_blank(*text.at)) ++text.at;
    return text.at != text.end && !is_line_end(*text.at);
}

// To the first word of this line or a later one; whether there is one.
inline bool find_row(TextCursor& text) {
    while (text.at != text.end && (is_blank(*text.at) || is_line_end(*text.at))) ++text.at;
    return text.at != text.end;
}

// The end of the word that begins at text.at.
inline const char* word_end(const TextCursor& text) {
    const char* at = text.at;
    while (at != text.end && !is_blank(*at) && !is_line_end(*at)) ++at;
    return at;
}

} // namespace knead

#pragma once
// A place in a text, and what it moves over: blanks part words, a row is a line, and empty lines between rows
// are passed over. Lines end in \n, \r or both. For the readers and writers of all formats that have text.

#include <cstddef>
#include <string_view>

namespace knead {

// What is left of the text: from the place on to the end.
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

// The word that begins at text.at.
inline std::string_view word_at(const TextCursor& text) {
    return {text.at, static_cast<std::size_t>(word_end(text) - text.at)};
}

} // namespace knead

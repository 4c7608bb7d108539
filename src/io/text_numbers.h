#pragma once
// Numbers in text files, read and written, and what messages about a text need.

#include "cloud/point_cloud.h"
#include "io/text_cursor.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace knead {

// Parses the word at text.at as a number of this type, stores it at `to` in native byte order, and moves
// behind the word; false, and no move, where it is none. Besides the standard spellings a leading plus, whole
// numbers written as "255.0", and the infinities and NaNs of old Windows libraries are taken; a real number
// out of range becomes the nearest that there is.
bool parse_scalar(TextCursor& text, ScalarType type, std::byte* to);

// The same for a word with nothing behind it; false where not all of it is the number.
bool parse_word(std::string_view word, ScalarType type, std::byte* to);

// Prints the shortest text that reads back as this value of this type, into 64 characters at least; how many
// it took.
std::size_t print_scalar(double value, ScalarType type, std::span<char> to);

// The same of a scalar as it lies in memory, which needs no double: exact for integers of 8 bytes, too.
std::size_t print_stored(const std::byte* from, ScalarType type, std::span<char> to);

// Appends what print_scalar() prints.
void append_number(std::string& text, double value, ScalarType type);

// The line that holds the byte `at`, from 1; `at` is within the file. Lines end in \n, \r\n or a lone \r.
std::size_t line_of(std::span<const std::byte> bytes, std::size_t at);

// Throws Error (input) for the line that holds the byte `at`, or for the last one where that is the end of
// the file: "scan.xyz:12: words". `shown` names the file.
[[noreturn]] void fail_at(std::span<const std::byte> bytes, std::size_t at, const std::string& shown,
                          const std::string& words);

// Text of a file for a message: printable, in quotes, and not too long.
std::string in_quotes(std::string_view text);

} // namespace knead

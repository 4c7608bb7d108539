#pragma once
// The lines of a text header in front of a body, for the readers of PLY and PCD.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace knead {

using Words = std::vector<std::string_view>;

// The words of a line.
Words split(std::string_view line);

// Cuts a header into lines and knows where it is.
class HeaderLines {
public:
    // `text` begins with the header and must outlive this; `shown` names the file in errors.
    HeaderLines(std::string_view text, std::string shown);

    // The next line's words; nothing at the end of the file.
    std::optional<Words> next();

    std::size_t at() const { return at_; }     // the byte behind the line
    std::size_t line() const { return line_; } // its number, from 1

    // Throws Error (input) for the line.
    [[noreturn]] void fail(const std::string& words) const;

private:
    std::string_view text_;
    std::string shown_;
    char ending_ = '\n';
    std::size_t at_ = 0;
    std::size_t line_ = 0;
};

} // namespace knead

#include "io/header_lines.h"

#include "base/error.h"

#include <algorithm>

namespace knead {

Words split(std::string_view line) {
    constexpr std::string_view blanks = " \t\r\v\f";
    Words words;
    for (std::size_t at = line.find_first_not_of(blanks); at != std::string_view::npos;) {
        const std::size_t end = std::min(line.find_first_of(blanks, at), line.size());
        words.push_back(line.substr(at, end - at));
        at = line.find_first_not_of(blanks, end);
    }
    return words;
}

HeaderLines::HeaderLines(std::string_view text, std::string shown) : text_(text), shown_(std::move(shown)) {
    // The first line tells how lines end. A lone \r must not swallow a first body byte that happens to be \n.
    const std::size_t end = text.find_first_of("\r\n");
    const bool lone_return =
        end != std::string_view::npos && text[end] == '\r' && text.substr(end + 1, 1) != "\n";
    ending_ = lone_return ? '\r' : '\n';
}

std::optional<Words> HeaderLines::next() {
    if (at_ >= text_.size()) return std::nullopt;
    const std::size_t end = std::min(text_.find(ending_, at_), text_.size());
    const std::string_view line = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return split(line);
}

void HeaderLines::fail(const std::string& words) const {
    throw Error(Trouble::input, shown_ + ":" + std::to_string(line_), words);
}

} // namespace knead

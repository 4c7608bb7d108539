#include "io/text_statements.h"

#include "io/text_numbers.h"

namespace knead {

TextStatements::TextStatements(std::span<const std::byte> bytes)
    : begin_(reinterpret_cast<const char*>(bytes.data())), text_{begin_, begin_ + bytes.size()} {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (std::string_view(begin_, bytes.size()).starts_with(mark)) text_.at += mark.size();
}

bool TextStatements::at_continuation(const char* at) const {
    return *at == '\\' && (at + 1 == text_.end || is_line_end(at[1]));
}

void TextStatements::pass_line_end() {
    const bool two = *text_.at == '\r' && text_.at + 1 != text_.end && text_.at[1] == '\n';
    text_.at += two ? 2 : 1;
}

std::optional<std::string_view> TextStatements::word() {
    while (find_word(text_) && at_continuation(text_.at)) {
        ++text_.at;
        if (text_.at != text_.end) pass_line_end();
    }
    if (text_.at == text_.end || is_line_end(*text_.at)) return std::nullopt;
    if (*text_.at == '#') {
        while (text_.at != text_.end && !is_line_end(*text_.at)) ++text_.at;
        return std::nullopt;
    }
    const char* const begin = text_.at;
    while (text_.at != text_.end && !is_blank(*text_.at) && !is_line_end(*text_.at) &&
           !at_continuation(text_.at))
        ++text_.at;
    return std::string_view(begin, static_cast<std::size_t>(text_.at - begin));
}

bool TextStatements::next() {
    while (begun_ && word()) continue;
    begun_ = true;
    while (find_row(text_)) {
        if (const auto first = word()) {
            keyword_ = *first;
            return true;
        }
    }
    return false;
}

double StatementSource::number(std::string_view word) const {
    double value = 0;
    if (!parse_word(word, ScalarType::float64, reinterpret_cast<std::byte*>(&value)))
        fail(word, "is no number; correct it");
    return value;
}

float StatementSource::float_number(std::string_view word) const {
    float value = 0;
    if (!parse_word(word, ScalarType::float32, reinterpret_cast<std::byte*>(&value)))
        fail(word, "is no number; correct it");
    return value;
}

void StatementSource::fail(std::string_view word, const std::string& words) const {
    const auto at = static_cast<std::size_t>(word.data() - reinterpret_cast<const char*>(bytes.data()));
    fail_at(bytes, at, shown, in_quotes(word) + " " + words);
}

} // namespace knead

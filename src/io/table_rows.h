#pragma once
// The rows of a table of numbers, walked one number at a time: by the reader, and again by the writer.

#include "io/table_layout.h"
#include "io/text_cursor.h"

#include <array>
#include <charconv>

namespace knead {

// Whether a remark begins here: # or //.
inline bool is_remark(const TextCursor& text) {
    if (text.at == text.end) return false;
    return *text.at == '#' || (*text.at == '/' && text.end - text.at > 1 && text.at[1] == '/');
}

inline void pass_over_line(TextCursor& text) {
    while (text.at != text.end && !is_line_end(*text.at)) ++text.at;
}

inline void pass_over_blanks(TextCursor& text) {
    while (text.at != text.end && is_blank(*text.at)) ++text.at;
}

class TableRows {
public:
    TableRows(std::span<const std::byte> bytes, const TableLayout& layout)
        : begin_(reinterpret_cast<const char*>(bytes.data())),
          layout_(layout), text_{begin_ + layout.rows_begin, begin_ + bytes.size()} {
        for (const char letter : {' ', '\t', '\v', '\f', '\r', '\n', '"', layout.separator})
            stops_[static_cast<unsigned char>(letter)] = true;
    }

    // To the next row; whether there is one. Remarks and empty lines are passed over, and so are counts of
    // points: the one at the start of a file, and one behind as many rows as the last promised.
    bool next_row() {
        while (find_row(text_)) {
            if (is_remark(text_)) {
                pass_over_line(text_);
                continue;
            }
            if (!layout_.has_count || rows_ != promised_ || !take_count()) break;
        }
        if (text_.at == text_.end) return false;
        is_first_ = true;
        ++rows_;
        return true;
    }

    // To the next number of this row, or what stands in its place; false where the row has none.
    bool next_number() {
        pass_over_blanks(text_);
        if (!is_first_ && layout_.separator != ' ') {
            if (text_.at == text_.end || *text_.at != layout_.separator) return false;
            ++text_.at;
            pass_over_blanks(text_);
        }
        is_first_ = false;
        quoted_ = text_.at != text_.end && *text_.at == '"';
        if (quoted_) ++text_.at;
        end_ = text_.at;
        while (end_ != text_.end && !stops_[static_cast<unsigned char>(*end_)]) ++end_;
        return end_ != text_.at && !is_remark(text_);
    }

    std::string_view number() const { return {text_.at, static_cast<std::size_t>(end_ - text_.at)}; }

    // Behind the number; false where a quote is not closed.
    bool pass_number() {
        text_.at = end_;
        if (!quoted_) return true;
        if (text_.at == text_.end || *text_.at != '"') return false;
        ++text_.at;
        return true;
    }

    // Behind the last number; whether only a separator and a remark follow it in its line.
    bool end_row() {
        TextCursor rest = text_;
        pass_over_blanks(rest);
        if (layout_.separator != ' ' && rest.at != rest.end && *rest.at == layout_.separator) {
            ++rest.at;
            pass_over_blanks(rest);
        }
        if (is_remark(rest)) pass_over_line(rest);
        if (rest.at != rest.end && !is_line_end(*rest.at)) {
            text_ = rest; // for the message
            return false;
        }
        text_ = rest;
        return true;
    }

    std::size_t at() const { return static_cast<std::size_t>(text_.at - begin_); }
    bool at_line_end() const { return text_.at == text_.end || is_line_end(*text_.at); }
    std::string_view rest_of_line() const {
        TextCursor rest = text_;
        pass_over_line(rest);
        return {text_.at, static_cast<std::size_t>(rest.at - text_.at)};
    }

    std::uint64_t rows() const { return rows_; }         // met so far
    std::uint64_t promised() const { return promised_; } // by the counts so far

private:
    // Passes over a line with a whole number alone.
    bool take_count() {
        std::uint64_t count = 0;
        const auto [end, trouble] = std::from_chars(text_.at, text_.end, count);
        TextCursor rest{end, text_.end};
        if (trouble != std::errc{} || count > ~std::uint64_t{0} - promised_) return false;
        pass_over_blanks(rest);
        if (is_remark(rest)) pass_over_line(rest);
        if (rest.at != rest.end && !is_line_end(*rest.at)) return false;
        promised_ += count;
        text_ = rest;
        return true;
    }

    const char* begin_;
    const TableLayout& layout_;
    TextCursor text_;
    const char* end_ = nullptr; // of the number at text_.at
    bool is_first_ = true;
    bool quoted_ = false;
    std::array<bool, 256> stops_{};
    std::uint64_t rows_ = 0;
    std::uint64_t promised_ = 0;
};

} // namespace knead

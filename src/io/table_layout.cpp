#include "io/table_layout.h"

#include "base/error.h"
#include "base/lower_case.h"
#include "io/table_rows.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

using Fields = std::vector<std::string_view>; // into the text, without quotes

// Up to most_table_columns + 1 of them; one that is missing between two separators is empty. `open_quote`
// becomes whether the last one has a quote that is not closed.
Fields split_line(std::string_view line, char separator, bool& open_quote) {
    Fields fields;
    open_quote = false;
    TextCursor text{line.data(), line.data() + line.size()};
    pass_over_blanks(text);
    while (text.at != text.end && fields.size() <= most_table_columns) {
        const bool quoted = *text.at == '"';
        if (quoted) ++text.at;
        const char* const begin = text.at;
        const auto stops = [&](char letter) {
            if (quoted) return letter == '"';
            return separator == ' ' ? is_blank(letter) : letter == separator;
        };
        while (text.at != text.end && !stops(*text.at)) ++text.at;
        const char* end = text.at;
        while (!quoted && end != begin && is_blank(end[-1])) --end;
        fields.emplace_back(begin, static_cast<std::size_t>(end - begin));
        open_quote = quoted && text.at == text.end;
        if (quoted && !open_quote) ++text.at;
        pass_over_blanks(text);
        if (separator != ' ' && text.at != text.end && *text.at == separator) {
            ++text.at;
            pass_over_blanks(text);
        }
    }
    return fields;
}

Fields split_line(std::string_view line, char separator) {
    bool ignored = false;
    return split_line(line, separator, ignored);
}

char separator_of(std::string_view line) {
    for (const char separator : {';', ','})
        if (line.find(separator) != std::string_view::npos) return separator;
    return ' ';
}

// Where a remark begins behind the numbers of a line: never within a word, since "1.#IND" is a number of old
// Windows libraries.
std::size_t remark_in(std::string_view line) {
    for (std::size_t at = 0; at < line.size(); ++at) {
        const bool begins =
            at == 0 || std::string_view(" \t\v\f,;\"").find(line[at - 1]) != std::string_view::npos;
        if (begins && is_remark({line.data() + at, line.data() + line.size()})) return at;
    }
    return line.size();
}

// Whether this is a number; with a decimal comma, too, where none parts the columns.
bool is_number(std::string_view word, char separator) {
    if (separator == ' ' && word.ends_with(',')) return false; // "1, 2 3" is a slip
    std::string text(word);
    if (separator != ',') std::replace(text.begin(), text.end(), ',', '.');
    std::array<std::byte, 8> ignored{};
    return parse_word(text, ScalarType::float64, ignored.data());
}

std::size_t count_numbers(const Fields& fields, char separator) {
    const auto is_right = [=](std::string_view field) { return is_number(field, separator); };
    return static_cast<std::size_t>(std::count_if(fields.begin(), fields.end(), is_right));
}

bool is_count(const Fields& fields) {
    return fields.size() == 1 && !fields[0].empty() &&
           std::all_of(fields[0].begin(), fields[0].end(), [](char c) { return c >= '0' && c <= '9'; });
}

bool names_axes(const Fields& fields) {
    std::array<bool, 3> found{};
    for (const std::string_view field : fields)
        if (const auto axis = axis_of(field)) found[*axis] = true;
    return found[0] && found[1] && found[2];
}

// A name that comes more than once.
std::optional<std::string_view> find_twice(Fields fields) {
    std::sort(fields.begin(), fields.end());
    const auto twice = std::adjacent_find(fields.begin(), fields.end());
    return twice == fields.end() ? std::nullopt : std::optional(*twice);
}

bool has_open_quote(std::string_view line) {
    bool open_quote = false;
    (void)split_line(line, separator_of(line), open_quote);
    return open_quote;
}

// Looks at one line after the other, up to the first row.
class Search {
public:
    Search(std::span<const std::byte> bytes, std::string shown)
        : bytes_(bytes), text_(reinterpret_cast<const char*>(bytes.data()), bytes.size()),
          shown_(std::move(shown)) {}

    TableLayout find() {
        bool found = false;
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        while (!found && at_ < text_.size()) {
            const std::size_t end = std::min(text_.find_first_of("\r\n", at_), text_.size());
            found = look_at(text_.substr(at_, end - at_));
            if (!found) at_ = std::min(end + 1, text_.size());
        }
        if (!layout_.has_count) layout_.rows_begin = at_;
        // Rows or not, something must say that there are points.
        if (!found && header_.empty() && !layout_.has_count)
            fail("ends before any row of numbers; there are no points in it");
        if (!found) take_columns_from_names();
        settle_names();
        if (layout_.separator != ',') settle_decimal_comma();
        return std::move(layout_);
    }

private:
    // Whether this line is the first row.
    bool look_at(std::string_view line) {
        TextCursor begin{line.data(), line.data() + line.size()};
        pass_over_blanks(begin);
        if (begin.at == begin.end) return false;
        if (is_remark(begin)) {
            line.remove_prefix(static_cast<std::size_t>(begin.at - line.data()));
            while (!line.empty() && (line.front() == '#' || line.front() == '/')) line.remove_prefix(1);
            const Fields names = split_line(line, separator_of(line));
            if (names.size() <= most_table_columns && names_axes(names) && !find_twice(names) &&
                !has_open_quote(line))
                remark_ = line;
            return false;
        }
        const std::string_view row = line.substr(0, remark_in(line));
        const char separator = separator_of(row);
        const Fields fields = split_line(row, separator);
        if (fields.size() > most_table_columns)
            fail("has more than " + std::to_string(most_table_columns) + " columns, too many for a cloud");
        const std::size_t numbers = count_numbers(fields, separator);
        if (numbers == fields.size()) return take_numbers(row, separator, fields);
        const Fields words = split_line(row, ' '); // the commas may be decimal ones
        if (separator == ',' && words.size() >= 3 && count_numbers(words, ' ') == words.size())
            return take_numbers(row, ' ', words);
        take_header(line, numbers > 0);
        return false;
    }

    bool take_numbers(std::string_view line, char separator, const Fields& fields) {
        if (!layout_.has_count && is_count(fields)) {
            layout_.has_count = true;
            layout_.rows_begin = at_;
            return false;
        }
        if (fields.size() < 3)
            fail("has " + std::to_string(fields.size()) + (fields.size() == 1 ? " number" : " numbers") +
                 " in its first row; a point needs x, y and z");
        layout_.separator = separator;
        layout_.columns = fields.size();
        if (line.find('\t') != std::string_view::npos) layout_.blank = '\t';
        return true;
    }

    void take_header(std::string_view line, bool has_numbers) {
        const char separator = separator_of(line);
        const Fields fields = split_line(line, separator);
        if (has_numbers && !names_axes(fields)) {
            const auto word = std::find_if(fields.begin(), fields.end(), [&](std::string_view field) {
                return !is_number(field, separator);
            });
            fail("has " + in_quotes(word == fields.end() ? line : *word) +
                 " among its numbers; correct it, or put # in front of the line if it is a remark");
        }
        if (has_open_quote(line)) fail("has a quote that is not closed; close it");
        if (const auto twice = find_twice(fields))
            fail("names the column " + in_quotes(*twice) + " twice; rename one of them");
        if (!header_.empty() || layout_.has_count || !names_axes(fields))
            fail(in_quotes(line) + " is neither a row of numbers nor a line of column names with x, y and z; "
                                   "correct it, or put # in front of it if it is a remark");
        header_ = line;
    }

    // As many columns as there are names, since no row says otherwise.
    void take_columns_from_names() {
        const std::string_view line = header_.empty() ? remark_ : header_;
        if (line.empty()) return;
        layout_.separator = separator_of(line);
        layout_.columns = split_line(line, layout_.separator).size();
    }

    // The separator of the rows where it gives a name for each column, else the line's own.
    char names_separator(std::string_view line) const {
        const Fields names = split_line(line, layout_.separator);
        return names.size() == layout_.columns && names_axes(names) ? layout_.separator : separator_of(line);
    }

    void settle_names() {
        const std::string_view line = header_.empty() ? remark_ : header_;
        if (line.empty()) return;
        const char separator = names_separator(line);
        const Fields names = split_line(line, separator);
        if (names.size() != layout_.columns) {
            if (header_.empty()) { // it was a remark after all
                layout_.words_in_remark = std::max(split_line(line, layout_.separator).size(), names.size());
                return;
            }
            at_ = static_cast<std::size_t>(line.data() - text_.data());
            fail("names " + std::to_string(names.size()) + " columns, but the first row has " +
                 std::to_string(layout_.columns) +
                 " numbers; correct it, or put # in front of it if it is a remark");
        }
        layout_.names.assign(names.begin(), names.end());
        const bool has_tabs = line.find('\t') != std::string_view::npos;
        layout_.names_separator = separator == ' ' && has_tabs ? '\t' : separator;
        const char* end = names.back().data() + names.back().size();
        layout_.has_quoted_names = end != line.data() + line.size() && *end == '"';
        layout_.names_end = static_cast<std::size_t>(end - text_.data()) + (layout_.has_quoted_names ? 1 : 0);
        if (layout_.rows_begin >= text_.size() && !layout_.has_count)
            layout_.separator = separator_of(line); // no row says otherwise
    }

    // Commas are decimal ones where there is one before there is a point, remarks aside.
    void settle_decimal_comma() {
        std::size_t at = text_.find_first_of(".,#/", layout_.rows_begin);
        while (at != std::string_view::npos && text_[at] != '.' && text_[at] != ',') {
            at = text_.find_first_of("\r\n", at);
            if (at != std::string_view::npos) at = text_.find_first_of(".,#/", at);
        }
        layout_.decimal_comma = at != std::string_view::npos && text_[at] == ',';
    }

    [[noreturn]] void fail(const std::string& words) const { fail_at(bytes_, at_, shown_, words); }

    std::span<const std::byte> bytes_;
    std::string_view text_;
    std::string shown_;
    std::size_t at_ = 0; // the line that is looked at
    TableLayout layout_;
    std::string_view header_; // the line of names, and the last remark that could be one
    std::string_view remark_;
};

} // namespace

std::optional<std::size_t> axis_of(std::string_view name) {
    constexpr std::array<std::array<std::string_view, 2>, 3> names = {
        {{"x", "points:0"}, {"y", "points:1"}, {"z", "points:2"}}};
    if (name.empty() || name.size() > names[0][1].size()) return std::nullopt;
    const std::string lower = lower_case(std::string(name));
    for (std::size_t axis = 0; axis < 3; ++axis)
        if (std::find(names[axis].begin(), names[axis].end(), lower) != names[axis].end()) return axis;
    return std::nullopt;
}

TableLayout find_table_layout(std::span<const std::byte> bytes, const std::string& shown) {
    return Search(bytes, shown).find();
}

bool looks_like_table(std::span<const std::byte> first_bytes) {
    try {
        const TableLayout layout = find_table_layout(first_bytes, "");
        return layout.rows_begin < first_bytes.size();
    } catch (const Error&) {
        return false;
    }
}

} // namespace knead

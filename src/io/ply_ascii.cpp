#include "base/error.h"
#include "io/ascii_rows.h"
#include "io/ply_rows.h"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 16;

// The line that holds the byte `at`, from 1; `at` is within the file.
std::size_t line_of(std::span<const std::byte> bytes, std::size_t at) {
    std::size_t line = 1;
    for (std::size_t i = 0; i < at; ++i) {
        const bool lone_return = bytes[i] == std::byte{'\r'} && bytes[i + 1] != std::byte{'\n'};
        if (bytes[i] == std::byte{'\n'} || lone_return) ++line;
    }
    return line;
}

// Numbers as programs write them beyond the standard: a plus sign, and what old Windows libraries print.
template<typename Real>
bool parse_odd_real(std::string_view word, Real& value) {
    if (word.starts_with('+')) word.remove_prefix(1);
    if (word.empty()) return false;
    const auto [end, trouble] = fast_float::from_chars(word.data(), word.data() + word.size(), value);
    // Out of range leaves an infinity or a zero, the nearest that there is.
    if (trouble != std::errc::invalid_argument && end == word.data() + word.size()) return true;
    const bool negative = word.starts_with('-');
    if (negative) word.remove_prefix(1);
    if (word.starts_with("1.#INF"))
        value = negative ? -std::numeric_limits<Real>::infinity() : std::numeric_limits<Real>::infinity();
    else if (word.starts_with("1.#IND") || word.starts_with("1.#QNAN") || word.starts_with("1.#SNAN") ||
             word == "nan(ind)" || word == "nan(snan)")
        value = std::numeric_limits<Real>::quiet_NaN();
    else
        return false;
    return true;
}

// Parses the word at text.at and moves behind it; false, and no move, where it is no number of this type.
template<typename Real>
bool parse_real(TextCursor& text, std::byte* to) {
    Real value{};
    const auto [end, trouble] = fast_float::from_chars(text.at, text.end, value);
    if (trouble == std::errc{} && (end == text.end || is_blank(*end) || is_line_end(*end))) {
        text.at = end;
    } else {
        const char* const stop = word_end(text);
        if (!parse_odd_real({text.at, stop}, value)) return false;
        text.at = stop;
    }
    std::memcpy(to, &value, sizeof value);
    return true;
}

template<typename Integer>
bool parse_integer(TextCursor& text, std::byte* to) {
    const char* const stop = word_end(text);
    Integer value{};
    const auto [end, trouble] = std::from_chars(text.at, stop, value);
    if (trouble != std::errc{} || end != stop) {
        // Some programs write whole numbers as "255.0".
        double real = 0;
        if (!parse_odd_real({text.at, stop}, real) || real != std::floor(real) ||
            real < static_cast<double>(std::numeric_limits<Integer>::min()) ||
            real > static_cast<double>(std::numeric_limits<Integer>::max()))
            return false;
        value = static_cast<Integer>(real);
    }
    text.at = stop;
    std::memcpy(to, &value, sizeof value);
    return true;
}

bool parse_scalar(TextCursor& text, ScalarType type, std::byte* to) {
    switch (type) {
    case ScalarType::int8:
        return parse_integer<std::int8_t>(text, to);
    case ScalarType::uint8:
        return parse_integer<std::uint8_t>(text, to);
    case ScalarType::int16:
        return parse_integer<std::int16_t>(text, to);
    case ScalarType::uint16:
        return parse_integer<std::uint16_t>(text, to);
    case ScalarType::int32:
        return parse_integer<std::int32_t>(text, to);
    case ScalarType::uint32:
        return parse_integer<std::uint32_t>(text, to);
    case ScalarType::float32:
        return parse_real<float>(text, to);
    case ScalarType::float64:
        return parse_real<double>(text, to);
    }
    return false;
}

// One element's rows: the cursor, and the words for what is wrong with them.
class Rows {
public:
    Rows(PlyBody& body, const PlyElement& element) : body_(body), element_(element) {
        const char* const text = reinterpret_cast<const char*>(body.bytes.data());
        text_ = {text + body.at, text + body.bytes.size()};
    }

    void begin(std::uint64_t row) {
        row_ = row;
        if (!find_row(text_))
            fail("is missing: the file ends before it, though the header promises " +
                 std::to_string(element_.count) +
                 " rows; the file is cut off or its header lies, get it again from its source");
    }

    void end() {
        if (find_word(text_))
            fail("has more values than the header has properties, from " + word() +
                 " on; correct the row or the header");
    }

    void scalar(const PlyProperty& property, ScalarType type, std::byte* to) {
        to_word(property);
        if (!parse_scalar(text_, type, to))
            fail("has " + word() + " for the property " + quoted(property.name) + ", which is no " +
                 std::string(name_of(type)) + "; correct the value or the property's type");
    }

    // Some programs declare a list at the end of a row and write nothing for it: it is taken as empty.
    std::uint64_t list_length(const PlyProperty& property) {
        if (&property == &element_.properties.back() && !find_word(text_)) return 0;
        to_word(property);
        TextCursor ahead = text_;
        std::int64_t length = -1;
        std::array<std::byte, sizeof length> bytes{};
        if (parse_integer<std::int64_t>(ahead, bytes.data()))
            std::memcpy(&length, bytes.data(), sizeof length);
        if (length < 0)
            fail("has a list " + quoted(property.name) + " of the length " + word() + "; correct the row");
        text_ = ahead;
        return static_cast<std::uint64_t>(length);
    }

    void pass_over(const PlyProperty& property) {
        to_word(property);
        text_.at = word_end(text_);
    }

    void finish() {
        body_.at = static_cast<std::size_t>(text_.at - reinterpret_cast<const char*>(body_.bytes.data()));
    }

private:
    void to_word(const PlyProperty& property) {
        if (!find_word(text_))
            fail("ends before the property " + quoted(property.name) +
                 "; a row is one line with a value for each property");
    }

    std::string word() const { return quoted({text_.at, word_end(text_)}); }

    [[noreturn]] void fail(const std::string& words) const {
        const auto at =
            static_cast<std::size_t>(text_.at - reinterpret_cast<const char*>(body_.bytes.data()));
        const std::size_t line = line_of(body_.bytes, std::min(at, body_.bytes.size() - 1));
        throw Error(Trouble::input, body_.shown + ":" + std::to_string(line),
                    element_.name + " row " + std::to_string(row_) + " " + words);
    }

    PlyBody& body_;
    const PlyElement& element_;
    TextCursor text_;
    std::uint64_t row_ = 0;
};

void report(Progress& progress, std::uint64_t row, const PlyElement& element) {
    if (row % rows_between_reports == 0)
        progress.step("parsing", static_cast<double>(row) / static_cast<double>(element.count));
}

void read_list(Rows& rows, const PlyProperty& property, Attribute& column) {
    const std::size_t size = size_of(property.type);
    // The length is not believed before its values have been met.
    for (std::uint64_t left = rows.list_length(property); left > 0; --left) {
        column.values.resize(column.values.size() + size);
        rows.scalar(property, property.type, column.values.data() + column.values.size() - size);
    }
    column.first.push_back(column.values.size() / size);
}

} // namespace

void read_ascii_rows(PlyBody& body, const PlyElement& element, std::vector<Attribute>& columns,
                     Progress& progress) {
    for (std::size_t p = 0; p < columns.size(); ++p)
        if (element.properties[p].is_list)
            columns[p].first.reserve(element.count + 1);
        else
            columns[p].values.resize(element.count * size_of(columns[p].type));

    Rows rows(body, element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        report(progress, row, element);
        rows.begin(row);
        for (std::size_t p = 0; p < columns.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list)
                read_list(rows, property, columns[p]);
            else
                rows.scalar(property, property.type, columns[p].values.data() + row * size_of(property.type));
        }
        rows.end();
    }
    rows.finish();
}

void skip_ascii_rows(PlyBody& body, const PlyElement& element, Progress& progress) {
    if (element.properties.empty()) return; // nothing is written for such rows, however many there are
    Rows rows(body, element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        report(progress, row, element);
        rows.begin(row);
        for (const PlyProperty& property : element.properties) {
            std::uint64_t words = property.is_list ? rows.list_length(property) : 1;
            for (; words > 0; --words) rows.pass_over(property);
        }
        rows.end();
    }
    rows.finish();
}

} // namespace knead

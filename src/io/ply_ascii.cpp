#include "base/error.h"
#include "io/ply_rows.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>
#include <cstring>

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 16;

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
            fail("has " + word() + " for the property " + in_quotes(property.name) + ", which is no " +
                 std::string(name_of(type)) + "; correct the value or the property's type");
    }

    // Some programs declare a list at the end of a row and write nothing for it: it is taken as empty.
    std::uint64_t list_length(const PlyProperty& property) {
        if (&property == &element_.properties.back() && !find_word(text_)) return 0;
        to_word(property);
        TextCursor ahead = text_;
        std::int64_t length = -1;
        std::array<std::byte, sizeof length> bytes{};
        if (parse_scalar(ahead, ScalarType::int64, bytes.data()))
            std::memcpy(&length, bytes.data(), sizeof length);
        if (length < 0)
            fail("has a list " + in_quotes(property.name) + " of the length " + word() + "; correct the row");
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
            fail("ends before the property " + in_quotes(property.name) +
                 "; a row is one line with a value for each property");
    }

    std::string word() const { return in_quotes({text_.at, word_end(text_)}); }

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

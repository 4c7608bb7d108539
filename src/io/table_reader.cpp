#include "base/error.h"
#include "base/lower_case.h"
#include "base/types.h"
#include "io/table.h"
#include "io/table_names.h"
#include "io/table_rows.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 16;

TableKind kind_of(const std::string& shown) {
    const std::string extension = lower_case(std::filesystem::path(shown).extension().string());
    for (const TableKind kind : {TableKind::xyz, TableKind::csv, TableKind::pts})
        if (extension == "." + std::string(name_of(kind))) return kind;
    return TableKind::txt;
}

// More rows than there will be, for all that the ends of the lines tell; no more than the bytes can hold.
std::size_t likely_rows(std::span<const std::byte> bytes, std::size_t columns) {
    std::size_t lines = static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), std::byte{'\n'}));
    if (lines == 0) lines = static_cast<std::size_t>(std::count(bytes.begin(), bytes.end(), std::byte{'\r'}));
    return std::min(lines, bytes.size() / (2 * columns)) + 1;
}

// Reads the rows into columns of float64.
class Reader {
public:
    Reader(const TableImage& image, const std::string& shown)
        : image_(image), shown_(shown), rows_(image.bytes, image.layout), columns_(image.layout.columns) {
        room_ = likely_rows(std::span(image.bytes).subspan(image.layout.rows_begin), columns_.size());
        for (Attribute& column : columns_) {
            column.type = ScalarType::float64;
            column.values.resize(room_ * sizeof(double));
        }
    }

    std::vector<Attribute> read(Progress& progress) {
        std::size_t row = 0;
        for (; rows_.next_row(); ++row) {
            if (row % rows_between_reports == 0)
                progress.step("parsing",
                              static_cast<double>(rows_.at()) / static_cast<double>(image_.bytes.size()));
            if (row == room_) grow();
            for (std::size_t c = 0; c < columns_.size(); ++c) read_number(c, row);
            if (!rows_.end_row()) refuse_rest();
        }
        if (rows_.promised() > row)
            fail("ends after " + std::to_string(row) + " rows, though " + std::to_string(rows_.promised()) +
                 " are promised in front of them; the file is cut off, or correct the number");
        for (Attribute& column : columns_) column.values.resize(row * sizeof(double));
        return std::move(columns_);
    }

    bool has_more_than_promised() const { return image_.layout.has_count && rows_.rows() > rows_.promised(); }
    std::uint64_t promised() const { return rows_.promised(); }

private:
    void grow() {
        room_ *= 2;
        for (Attribute& column : columns_) column.values.resize(room_ * sizeof(double));
    }

    void read_number(std::size_t c, std::size_t row) {
        if (!rows_.next_number()) refuse_missing(c);
        const std::string_view word = rows_.number();
        if (parse(word, columns_[c].values.data() + row * sizeof(double)) && rows_.pass_number()) return;
        fail("has " + in_quotes(word) + " in column " + column_name(c) +
             ", which is no number; correct it, or put # in front of the line if it is a remark" +
             (word.find(',') == std::string_view::npos
                  ? ""
                  : " (decimal commas are understood where no number has a decimal point)"));
    }

    bool parse(std::string_view word, std::byte* to) {
        if (image_.layout.decimal_comma) {
            if (word.find('.') != std::string_view::npos) return false;
            swapped_.assign(word);
            std::replace(swapped_.begin(), swapped_.end(), ',', '.');
            word = swapped_;
        }
        return parse_word(word, ScalarType::float64, to);
    }

    std::string column_name(std::size_t c) const {
        constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
        if (!image_.layout.names.empty()) return in_quotes(image_.layout.names[c]);
        return c < 3 ? std::string(axes[c]) : std::to_string(c + 1);
    }

    [[noreturn]] void refuse_missing(std::size_t c) const {
        if (rows_.at_line_end())
            fail("has " + std::to_string(c) + (c == 1 ? " number" : " numbers") + ", but there are " +
                 std::to_string(columns_.size()) + " columns; complete the row, or delete it");
        fail("has no number in column " + column_name(c) + ", but " + in_quotes(rows_.rest_of_line()) +
             "; each row needs a number in each column");
    }

    [[noreturn]] void refuse_rest() const {
        fail("has more numbers than there are columns, from " + in_quotes(rows_.rest_of_line()) +
             " on; correct it, or put # in front of what is a remark");
    }

    [[noreturn]] void fail(const std::string& words) const {
        fail_at(image_.bytes, rows_.at(), shown_, words);
    }

    const TableImage& image_;
    const std::string& shown_;
    TableRows rows_;
    std::vector<Attribute> columns_;
    std::size_t room_ = 0; // rows that there is memory for
    std::string swapped_;  // a word with a point for its comma
};

} // namespace

std::string_view name_of(TableKind kind) {
    switch (kind) {
    case TableKind::xyz:
        return "xyz";
    case TableKind::txt:
        return "txt";
    case TableKind::csv:
        return "csv";
    case TableKind::pts:
        return "pts";
    }
    return "";
}

std::string_view TableImage::encoding() const {
    if (layout.separator == ',') return "columns parted by commas";
    if (layout.separator == ';')
        return layout.decimal_comma ? "columns parted by semicolons, decimal commas"
                                    : "columns parted by semicolons";
    if (layout.blank == '\t')
        return layout.decimal_comma ? "columns parted by tabs, decimal commas" : "columns parted by tabs";
    return layout.decimal_comma ? "columns parted by blanks, decimal commas" : "columns parted by blanks";
}

PointCloud read_table(std::vector<std::byte> bytes, const std::string& shown, Progress& progress) {
    auto image = std::make_shared<TableImage>();
    image->bytes = std::move(bytes);
    image->layout = find_table_layout(image->bytes, shown);
    image->kind = kind_of(shown);
    PointCloud cloud;
    Reader reader(*image, shown);
    cloud.attributes = reader.read(progress);
    if (reader.has_more_than_promised())
        cloud.remarks.push_back("it has more rows than the " + std::to_string(reader.promised()) +
                                " points that it promises; all of them are read");
    cloud.coordinate_columns = name_table_columns(image->layout, image->kind, cloud.attributes);
    if (cloud.attributes[0].values.size() / size_of(cloud.attributes[0].type) >= no_index)
        throw Error(Trouble::input, shown,
                    "has more than the 4294967294 points that knead takes; cut the cloud into pieces");
    set_positions_from_columns(cloud);
    cloud.image = std::move(image);
    return cloud;
}

} // namespace knead

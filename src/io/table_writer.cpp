#include "base/error.h"
#include "base/require.h"
#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/table.h"
#include "io/table_rows.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

// What the functions below share.
struct Patching {
    const TableImage& image;
    std::vector<const PosedColumn*> posed; // one a column; null where nothing changes
    std::vector<AddedColumn> added;
    std::string shown;
    PatchedCopy copy;

    char separator() const {
        return image.layout.separator == ' ' ? image.layout.blank : image.layout.separator;
    }
};

// The shortest text of a number, with the file's decimal sign.
std::string_view print(double value, ScalarType type, const TableLayout& layout,
                       std::array<char, 64>& buffer) {
    const std::size_t length = print_scalar(value, type, buffer);
    if (layout.decimal_comma)
        std::replace(buffer.begin(), buffer.begin() + static_cast<std::ptrdiff_t>(length), '.', ',');
    return {buffer.data(), length};
}

void patch_number(Patching& patching, const PosedColumn& column, std::size_t point, const TableRows& rows) {
    const auto value = posed_value(column, point, patching.shown);
    if (!value) return;
    std::array<char, 64> buffer{};
    // Normals are computed as floats; more digits would be noise.
    const ScalarType type = column.rest == nullptr ? ScalarType::float32 : ScalarType::float64;
    const std::string_view text = print(*value, type, patching.image.layout, buffer);
    patching.copy.replace(rows.at(), rows.number().size(), text);
}

void add_numbers(Patching& patching, std::size_t point, const TableRows& rows) {
    std::string text;
    for (const AddedColumn& column : patching.added) {
        std::array<char, 64> buffer{};
        text += patching.separator();
        text += print(static_cast<double>(column.values[point]), ScalarType::float32, patching.image.layout,
                      buffer);
    }
    patching.copy.replace(rows.at(), 0, text);
}

void add_names(Patching& patching) {
    const TableLayout& layout = patching.image.layout;
    const std::string quote = layout.has_quoted_names ? "\"" : "";
    std::string text;
    for (const AddedColumn& column : patching.added) {
        text += layout.names_separator;
        text.append(quote).append(column.name).append(quote);
    }
    patching.copy.replace(layout.names_end, 0, text);
}

// Whether names that something else parts than the rows, "x,y,z,the class" above rows parted by blanks, hold
// what parts the rows: with more columns, that could give as many words, which would then be the names.
bool names_are_parted_twice(const TableLayout& layout) {
    const bool is_blank = layout.separator == ' ';
    const bool names_are = layout.names_separator == ' ' || layout.names_separator == '\t';
    if (is_blank ? names_are : layout.names_separator == layout.separator) return false;
    return std::ranges::any_of(layout.names, [&](const std::string& name) {
        return name.find_first_of(is_blank ? " \t" : std::string(1, layout.separator)) != std::string::npos;
    });
}

void patch_rows(Patching& patching, std::size_t points) {
    TableRows rows(patching.image.bytes, patching.image.layout);
    for (std::size_t point = 0; point < points; ++point) {
        require(rows.next_row(), "rows lie where they were read");
        for (const PosedColumn* const column : patching.posed) {
            require(rows.next_number(), "numbers lie where they were read");
            if (column != nullptr) patch_number(patching, *column, point, rows);
            require(rows.pass_number(), "numbers lie where they were read");
        }
        if (!patching.added.empty()) add_numbers(patching, point, rows);
        require(rows.end_row(), "rows end where they were read");
    }
}

std::vector<std::string> write_patched(FileInTheMaking& file, const TableImage& image,
                                       const PointCloud& cloud, const PosedShape& shape,
                                       const std::string& shown, Progress& progress) {
    require(image.layout.columns == cloud.attributes.size(), "a cloud has the columns of its image");
    BlockWriter out(file, image.bytes.size(), progress);
    const std::vector<PosedColumn> columns = posed_columns(cloud, shape);
    Patching patching{image, {}, with_free_names(cloud, shape.added), shown, PatchedCopy(image.bytes, out)};
    patching.posed.resize(cloud.attributes.size(), nullptr);
    for (const PosedColumn& column : columns) patching.posed[column.column] = &column;
    if (!patching.added.empty() && image.layout.columns + patching.added.size() > most_table_columns)
        throw Error(Trouble::output, shown,
                    "columns cannot be added, since a table has at most " +
                        std::to_string(most_table_columns) + "; save it as .ply, or without them");
    if (!patching.added.empty() && names_are_parted_twice(image.layout))
        throw Error(
            Trouble::output, shown,
            "columns cannot be added, since the names in the file that it came from are parted otherwise "
            "than its rows and hold what parts those; save it as .ply, or without them");
    const bool nameless = image.layout.names.empty();
    if (!patching.added.empty() && nameless &&
        image.layout.words_in_remark >= image.layout.columns + patching.added.size())
        throw Error(
            Trouble::output, shown,
            "columns cannot be added, since a remark with x, y and z in the file that it came from would "
            "then be taken for the columns' names; remove that remark, or save as .ply");
    if (!patching.added.empty() && !nameless) add_names(patching);
    if (!columns.empty() || !patching.added.empty()) patch_rows(patching, cloud.size());
    patching.copy.finish();
    out.finish();
    if (patching.added.empty() || !nameless) return {};
    return {"the added columns stand behind the others without their names, since the file names no columns"};
}

} // namespace

std::vector<std::string> write_table(TableKind kind, FileInTheMaking& file, const PointCloud& cloud,
                                     const PosedShape& shape, const std::string& shown, Progress& progress) {
    const auto* image = dynamic_cast<const TableImage*>(cloud.image.get());
    return image != nullptr && image->kind == kind
               ? write_patched(file, *image, cloud, shape, shown, progress)
               : write_new_table(file, kind, cloud, shape, shown, progress);
}

} // namespace knead

#include "io/ply_rows.h"
#include "io/text_rows.h"

namespace knead {

namespace {

constexpr std::size_t rows_between_reports = std::size_t{1} << 16;

// A cursor at the first row of an element.
TextRows rows_of(const PlyBody& body, const PlyElement& element) {
    return {body.bytes, body.at, body.shown, {element.name + " row", "rows", "property", "properties"}};
}

// Some programs declare a list at the end of a row and write nothing for it: it is taken as empty.
std::uint64_t list_length(TextRows& rows, const PlyElement& element, const PlyProperty& property) {
    if (&property == &element.properties.back() && !rows.has_word()) return 0;
    return rows.list_length(property.name);
}

void report(Progress& progress, std::uint64_t row, const PlyElement& element) {
    if (row % rows_between_reports == 0)
        progress.step("parsing", static_cast<double>(row) / static_cast<double>(element.count));
}

void read_list(TextRows& rows, const PlyElement& element, const PlyProperty& property, Attribute& column) {
    const std::size_t size = size_of(property.type);
    // The length is not believed before its values have been met.
    for (std::uint64_t left = list_length(rows, element, property); left > 0; --left) {
        column.values.resize(column.values.size() + size);
        rows.number(property.name, property.type, column.values.data() + column.values.size() - size);
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

    TextRows rows = rows_of(body, element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        report(progress, row, element);
        rows.begin(row, element.count);
        for (std::size_t p = 0; p < columns.size(); ++p) {
            const PlyProperty& property = element.properties[p];
            if (property.is_list)
                read_list(rows, element, property, columns[p]);
            else
                rows.number(property.name, property.type,
                            columns[p].values.data() + row * size_of(property.type));
        }
        rows.end();
    }
    body.at = rows.at();
}

void skip_ascii_rows(PlyBody& body, const PlyElement& element, Progress& progress) {
    if (element.properties.empty()) return; // nothing is written for such rows, however many there are
    TextRows rows = rows_of(body, element);
    for (std::uint64_t row = 0; row < element.count; ++row) {
        report(progress, row, element);
        rows.begin(row, element.count);
        for (const PlyProperty& property : element.properties) {
            std::uint64_t words = property.is_list ? list_length(rows, element, property) : 1;
            for (; words > 0; --words) rows.pass_over(property.name);
        }
        rows.end();
    }
    body.at = rows.at();
}

} // namespace knead

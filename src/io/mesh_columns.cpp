#include "io/mesh_columns.h"

#include "cloud/colors.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <iterator>

namespace knead {

namespace {

ThreeColumns chosen(const std::vector<NewColumn>& columns, const std::array<std::size_t, 3>& places) {
    return {columns[places[0]], columns[places[1]], columns[places[2]]};
}

std::vector<std::string> words_about(const std::vector<std::string>& names, const std::string& format) {
    if (names.empty()) return {};
    return {columns_are(names) + " left out, since " + format + " has no place for " +
            (names.size() == 1 ? "it" : "them")};
}

std::vector<std::string> names_of_added(const PosedShape& shape) {
    std::vector<std::string> names;
    for (const AddedColumn& column : shape.added) names.push_back(column.name);
    return names;
}

} // namespace

bool MeshColumns::colours_are_bytes() const {
    return colours && std::ranges::all_of(
                          *colours, [](const NewColumn& column) { return column.type == ScalarType::uint8; });
}

MeshColumns mesh_columns(const PointCloud& cloud, const std::vector<NewColumn>& all) {
    MeshColumns columns;
    columns.coordinates = chosen(all, cloud.coordinate_columns);
    if (const auto normals = find_normals(cloud)) columns.normals = chosen(all, *normals);
    if (const auto colours = find_colors(cloud)) {
        columns.colours = chosen(all, *colours);
        columns.brightest = brightest_value(cloud, *colours);
    }
    return columns;
}

void append_values(std::string& line, const ThreeColumns& columns, std::size_t i, const std::string& shown) {
    std::array<char, 64> buffer{};
    for (const NewColumn& column : columns)
        (line += ' ').append(buffer.data(), print_new_value(column, i, shown, buffer));
}

void append_fractions(std::string& line, const ThreeColumns& columns, double brightest, std::size_t i,
                      const std::string& shown) {
    for (const NewColumn& column : columns) {
        const std::size_t begin = line.size();
        append_number(line += ' ', new_value(column, i, shown) / brightest, ScalarType::float32);
        // Some programs take numbers without a point for bytes.
        if (line.find_first_of(".en", begin) == std::string::npos) line += ".0";
    }
}

std::vector<std::string> words_about_left_out(const PointCloud& cloud, const MeshColumns& columns,
                                              const PosedShape& shape, const std::string& format) {
    std::vector<std::string> names;
    const auto is_one_of = [](const ThreeColumns& three, const Attribute& attribute) {
        return std::ranges::any_of(three, [&](const NewColumn& c) { return c.attribute == &attribute; });
    };
    for (const Attribute& attribute : cloud.attributes) {
        const bool written = is_one_of(columns.coordinates, attribute) ||
                             (columns.normals && is_one_of(*columns.normals, attribute)) ||
                             (columns.colours && is_one_of(*columns.colours, attribute));
        if (!written) names.push_back(attribute.name);
    }
    std::ranges::copy(names_of_added(shape), std::back_inserter(names));
    return words_about(names, format);
}

std::vector<std::string> words_about_added(const PosedShape& shape, const std::string& format) {
    return words_about(names_of_added(shape), format);
}

} // namespace knead

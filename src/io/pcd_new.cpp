#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/pcd.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

namespace knead {

namespace {

// A field of the new file: one column, or the colours in one number.
struct NewField {
    std::string name;
    std::string_view letter;
    std::size_t size = 4;
    std::uint64_t count = 1;
    const NewColumn* column = nullptr;           // null for colours
    std::array<const NewColumn*, 4> colors = {}; // blue, green, red and, if there is one, alpha
};

const NewColumn* find_byte_column(const std::vector<NewColumn>& columns, std::string_view name) {
    for (const NewColumn& column : columns)
        if (column.name == name && column.type == ScalarType::uint8 && !column.is_list()) return &column;
    return nullptr;
}

// 8-bit colours as the Point Cloud Library packs them: a float "rgb", or with transparency a whole "rgba".
// Other colours stay columns of their own.
std::optional<NewField> packed_colors(const std::vector<NewColumn>& columns) {
    NewField field;
    constexpr std::array<std::string_view, 4> names = {"blue", "green", "red", "alpha"};
    for (std::size_t c = 0; c < names.size(); ++c) field.colors[c] = find_byte_column(columns, names[c]);
    if (field.colors[0] == nullptr || field.colors[1] == nullptr || field.colors[2] == nullptr)
        return std::nullopt;
    const bool transparent = field.colors[3] != nullptr;
    field.name = transparent ? "rgba" : "rgb";
    field.letter = transparent ? "U" : "F";
    // The name may be taken by a column that is something else.
    const auto is_taken = [&](const NewColumn& column) { return column.name == field.name; };
    if (std::any_of(columns.begin(), columns.end(), is_taken)) return std::nullopt;
    return field;
}

// How many numbers of a point a field of this column has; nothing where that is not one number for all
// points.
std::optional<std::uint64_t> count_of(const NewColumn& column) {
    if (!column.is_list() || column.attribute->first.size() < 2) return 1; // of no points, any is right
    const auto length = common_length(*column.attribute);
    const bool fits = length && *length > 0 && *length <= std::numeric_limits<std::uint32_t>::max();
    return fits ? length : std::nullopt;
}

std::vector<NewField> new_fields(const std::vector<NewColumn>& columns, std::vector<std::string>& left_out) {
    std::vector<NewField> fields;
    std::vector<std::string> too_many;
    const std::optional<NewField> colors = packed_colors(columns);
    const auto is_axis = [](const NewColumn& c) { return c.name == "x" || c.name == "y" || c.name == "z"; };
    std::size_t room = most_pcd_fields - 3 - (colors ? 1 : 0); // besides x, y, z and colours in one
    for (const NewColumn& column : columns) {
        if (colors &&
            std::find(colors->colors.begin(), colors->colors.end(), &column) != colors->colors.end()) {
            if (&column == colors->colors[2]) fields.push_back(*colors);
            continue;
        }
        const auto count = count_of(column);
        if (!count) {
            left_out.push_back("the lists " + in_quotes(column.name) +
                               " are left out, since PCD asks for lists that are equally long and not empty");
            continue;
        }
        if (!is_axis(column) && room == 0) {
            too_many.push_back(column.name);
            continue;
        }
        room -= is_axis(column) ? 0 : 1;
        fields.push_back(
            {column.name, pcd_letter_of(column.type), size_of(column.type), *count, &column, {}});
    }
    if (!too_many.empty())
        left_out.push_back(columns_are(too_many) + " left out, since a PCD file has at most " +
                           std::to_string(most_pcd_fields) + " fields");
    return fields;
}

// Nothing is lost by it, but who opens the file elsewhere should know.
void remark_on_wide_coordinates(const std::vector<NewColumn>& columns, const PointCloud& cloud,
                                std::vector<std::string>& left_out) {
    for (const std::size_t column : cloud.coordinate_columns)
        if (const ScalarType type = columns[column].type; type != ScalarType::float32) {
            const bool is_own = type == columns[column].attribute->type;
            left_out.push_back("coordinates are written as " + std::string(name_of(type)) +
                               (is_own ? ", as the cloud has them" : ", for the fractions of the pose") +
                               "; programs of the Point Cloud Library take only float32");
            return;
        }
}

std::string new_header(std::size_t points, const std::vector<NewField>& fields) {
    std::string names = "FIELDS", sizes = "SIZE", letters = "TYPE", counts = "COUNT";
    for (const NewField& field : fields) {
        (names += ' ') += field.name;
        (sizes += ' ') += std::to_string(field.size);
        (letters += ' ') += field.letter;
        (counts += ' ') += std::to_string(field.count);
    }
    const std::string number = std::to_string(points);
    return "# .PCD v0.7 - Point Cloud Data file format\nVERSION 0.7\n" + names + '\n' + sizes + '\n' +
           letters + '\n' + counts + "\nWIDTH " + number + "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " +
           number + "\nDATA binary\n";
}

void append_field(BlockWriter& out, const NewField& field, std::size_t point, const std::string& shown) {
    if (field.column == nullptr) {
        for (const NewColumn* part : field.colors) {
            const auto byte = part == nullptr ? std::array<std::byte, 8>{} : new_scalar(*part, point, shown);
            out.append(std::span(byte).first(1));
        }
    } else if (field.column->is_list()) {
        const Attribute& list = *field.column->attribute;
        out.append_little(list.values.data() + list.first[point] * field.size, field.count, field.size);
    } else {
        out.append_little(new_scalar(*field.column, point, shown).data(), 1, field.size);
    }
}

} // namespace

std::vector<std::string> write_new_pcd(FileInTheMaking& file, const PointCloud& cloud,
                                       const PosedShape& shape, const std::string& shown,
                                       Progress& progress) {
    ColumnsToWrite all = columns_to_write(cloud, shape);
    std::vector<NewColumn>& columns = all.columns;
    name_standard_columns(columns, cloud, {"normal_x", "normal_y", "normal_z"});
    for (NewColumn& column : columns)
        if (column.name == "_") column.name.clear(); // padding, in PCD
    std::vector<std::string> left_out = make_names_legal(columns, is_word_letter);
    const std::vector<NewField> fields = new_fields(columns, left_out);
    remark_on_wide_coordinates(columns, cloud, left_out);
    const std::string header = new_header(cloud.size(), fields);
    std::size_t total = header.size();
    for (const NewField& field : fields) total += cloud.size() * field.size * field.count;
    BlockWriter out(file, total, progress);
    out.append(header);
    for (std::size_t point = 0; point < cloud.size(); ++point)
        for (const NewField& field : fields) append_field(out, field, point, shown);
    out.finish();
    return left_out;
}

} // namespace knead

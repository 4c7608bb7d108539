#include "io/new_columns.h"

#include "base/require.h"
#include "io/free_names.h"
#include "io/scalar_bytes.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <cmath>

namespace knead {

std::vector<AddedColumn> with_free_names(const PointCloud& cloud, std::vector<AddedColumn> added) {
    if (added.empty()) return added;
    FreeNames names;
    for (const Attribute& attribute : cloud.attributes) (void)names.take_exactly(attribute.name);
    for (AddedColumn& column : added) {
        require(column.values.size() == cloud.size(), "an added column has a value a point");
        column.name = names.take(column.name);
    }
    return added;
}

namespace {

// Whole coordinates that a pose changes have fractions then: as a type that holds both. There is none for 8
// bytes.
ScalarType type_with_fractions(ScalarType type) {
    if (!is_whole(type) || size_of(type) == 8) return type;
    return size_of(type) <= 2 ? ScalarType::float32 : ScalarType::float64;
}

bool is_changed(const PosedColumn& coordinate, std::size_t points) {
    for (std::size_t i = 0; i < points; ++i)
        if (coordinate.posed[3 * i] != coordinate.rest[3 * i] && std::isfinite(coordinate.rest[3 * i]))
            return true;
    return false;
}

} // namespace

ColumnsToWrite columns_to_write(const PointCloud& cloud, const PosedShape& shape) {
    ColumnsToWrite all;
    all.posed = posed_columns(cloud, shape);
    all.added = with_free_names(cloud, shape.added);
    for (const Attribute& attribute : cloud.attributes)
        all.columns.push_back({attribute.name, attribute.type, &attribute, nullptr, nullptr});
    for (PosedColumn& column : all.posed) {
        if (column.rest != nullptr && is_whole(column.type) && is_changed(column, cloud.size()))
            column.type = type_with_fractions(column.type);
        all.columns[column.column].posed = &column;
        all.columns[column.column].type = column.type;
    }
    for (const AddedColumn& column : all.added)
        all.columns.push_back({column.name, ScalarType::float32, nullptr, nullptr, column.values.data()});
    return all;
}

void name_standard_columns(std::vector<NewColumn>& columns, const PointCloud& cloud,
                           const std::array<std::string_view, 3>& normals) {
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    const auto normal_columns = find_normals(cloud);
    for (std::size_t axis = 0; axis < 3; ++axis) {
        columns[cloud.coordinate_columns[axis]].name = axes[axis];
        if (normal_columns) columns[(*normal_columns)[axis]].name = normals[axis];
    }
}

std::string columns_are(const std::vector<std::string>& names) {
    constexpr std::size_t longest = 600; // bytes, about; what is more is counted
    if (names.size() == 1) return "the column " + in_quotes(names[0]) + " is";
    std::string words = "the columns " + in_quotes(names[0]);
    std::size_t shown = 1;
    for (; shown + 1 < names.size() && words.size() < longest; ++shown)
        words += ", " + in_quotes(names[shown]);
    const std::size_t more = names.size() - shown;
    return words + " and " + (more == 1 ? in_quotes(names.back()) : std::to_string(more) + " more") + " are";
}

bool is_word_letter(char letter) {
    return static_cast<unsigned char>(letter) > ' ' && letter != '\x7F';
}

std::vector<std::string> make_names_legal(std::vector<NewColumn>& columns, bool (*is_legal)(char letter),
                                          std::size_t longest) {
    FreeNames names;
    std::vector<NewColumn*> illegal;
    // Names that are good stay with their columns, whatever the others become.
    for (NewColumn& column : columns) {
        const std::string& name = column.name;
        const bool good =
            !name.empty() && name.size() <= longest && std::all_of(name.begin(), name.end(), is_legal);
        if (!good || !names.take_exactly(name)) illegal.push_back(&column);
    }
    std::vector<std::string> words;
    for (NewColumn* const column : illegal) {
        std::string name = column->name.empty() ? "unnamed" : column->name;
        std::replace_if(
            name.begin(), name.end(), [&](char letter) { return !is_legal(letter); }, '_');
        name = names.take(name, longest);
        words.push_back("the column " + in_quotes(column->name) + " is called " + in_quotes(name) + " there");
        column->name = std::move(name);
    }
    return words;
}

std::optional<std::uint64_t> common_length(const Attribute& list) {
    if (list.first.size() < 2) return 0;
    const std::uint64_t length = list.first[1] - list.first[0];
    for (std::size_t i = 1; i + 1 < list.first.size(); ++i)
        if (list.first[i + 1] - list.first[i] != length) return std::nullopt;
    return length;
}

std::array<std::byte, 8> new_scalar(const NewColumn& column, std::size_t i, const std::string& shown) {
    std::array<std::byte, 8> scalar{};
    if (column.attribute == nullptr) {
        std::memcpy(scalar.data(), column.added + i, sizeof(float));
        return scalar;
    }
    if (column.posed != nullptr)
        if (const auto value = posed_value(*column.posed, i, shown)) {
            store_scalar(*value, column.type, scalar.data());
            return scalar;
        }
    const Attribute& own = *column.attribute;
    const std::size_t size = size_of(own.type);
    if (own.type == column.type)
        std::memcpy(scalar.data(), own.values.data() + i * size, size);
    else
        store_scalar(value_at(own, i), column.type, scalar.data());
    return scalar;
}

double new_value(const NewColumn& column, std::size_t i, const std::string& shown) {
    if (column.attribute == nullptr) return static_cast<double>(column.added[i]);
    if (column.posed != nullptr)
        if (const auto value = posed_value(*column.posed, i, shown)) return *value;
    return value_at(*column.attribute, i);
}

std::size_t print_new_value(const NewColumn& column, std::size_t i, const std::string& shown,
                            std::span<char> to, std::uint64_t place) {
    if (column.attribute == nullptr)
        return print_scalar(static_cast<double>(column.added[i]), ScalarType::float32, to);
    if (column.posed != nullptr)
        if (const auto value = posed_value(*column.posed, i, shown))
            return print_scalar(*value, column.posed->rest == nullptr ? ScalarType::float32 : column.type,
                                to);
    const Attribute& own = *column.attribute;
    const std::size_t at = own.is_list() ? own.first[i] + place : i;
    return print_stored(own.values.data() + at * size_of(own.type), own.type, to);
}

} // namespace knead

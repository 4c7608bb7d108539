#include "io/new_columns.h"

#include "base/require.h"
#include "io/scalar_bytes.h"
#include "io/text_numbers.h"

#include <algorithm>

namespace knead {

std::vector<AddedColumn> with_free_names(const PointCloud& cloud, std::vector<AddedColumn> added) {
    for (std::size_t a = 0; a < added.size(); ++a) {
        require(added[a].values.size() == cloud.size(), "an added column has a value a point");
        const std::string name = added[a].name;
        const auto is_taken = [&](const std::string& candidate) {
            return find_attribute(cloud, candidate).has_value() ||
                   std::any_of(added.begin(), added.begin() + static_cast<std::ptrdiff_t>(a),
                               [&](const AddedColumn& other) { return other.name == candidate; });
        };
        for (unsigned number = 2; is_taken(added[a].name); ++number)
            added[a].name = name + "_" + std::to_string(number);
    }
    return added;
}

std::vector<NewColumn> new_columns(const PointCloud& cloud, const std::vector<PosedColumn>& posed,
                                   const std::vector<AddedColumn>& added) {
    std::vector<NewColumn> columns;
    for (const Attribute& attribute : cloud.attributes)
        columns.push_back({attribute.name, attribute.type, &attribute, nullptr, nullptr});
    for (const PosedColumn& column : posed) columns[column.column].posed = &column;
    for (const AddedColumn& column : added)
        columns.push_back({column.name, ScalarType::float32, nullptr, nullptr, column.values.data()});
    return columns;
}

bool is_word_letter(char letter) {
    return static_cast<unsigned char>(letter) > ' ' && letter != '\x7F';
}

std::vector<std::string> make_names_legal(std::vector<NewColumn>& columns, bool (*is_legal)(char letter),
                                          std::size_t longest) {
    std::vector<std::string> words;
    for (std::size_t c = 0; c < columns.size(); ++c) {
        const std::string own = columns[c].name;
        std::string base = own.empty() ? "unnamed" : own;
        std::replace_if(
            base.begin(), base.end(), [&](char letter) { return !is_legal(letter); }, '_');
        std::string name = base.substr(0, longest);
        const auto is_taken = [&] {
            for (std::size_t other = 0; other < columns.size(); ++other)
                if (other != c && columns[other].name == name && (other < c || columns[other].name != own))
                    return true;
            return false;
        };
        for (unsigned number = 2; is_taken(); ++number) {
            const std::string suffix = "_" + std::to_string(number);
            name = base.substr(0, longest - suffix.size()) + suffix;
        }
        if (name == own) continue;
        words.push_back("the column " + in_quotes(own) + " is called " + in_quotes(name) + " there");
        columns[c].name = std::move(name);
    }
    return words;
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
    const std::size_t size = size_of(column.type);
    std::memcpy(scalar.data(), column.attribute->values.data() + i * size, size);
    return scalar;
}

double new_value(const NewColumn& column, std::size_t i, const std::string& shown) {
    if (column.attribute == nullptr) return static_cast<double>(column.added[i]);
    if (column.posed != nullptr)
        if (const auto value = posed_value(*column.posed, i, shown)) return *value;
    return value_at(*column.attribute, i);
}

} // namespace knead

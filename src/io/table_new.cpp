#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/table.h"
#include "io/text_numbers.h"

#include <algorithm>
#include <array>
#include <optional>

namespace knead {

namespace {

// One column of the new table: a column of the cloud, or one place in the lists of it.
struct NewNumber {
    std::string name;
    const NewColumn* column = nullptr;
    std::uint64_t place = 0; // in a list
};

bool is_name_letter(char letter) {
    return is_word_letter(letter) && letter != ',' && letter != ';' && letter != '"';
}

// Where a column stands: x y z first, in .pts files intensity and colours behind them; nothing for what is
// left out there.
std::optional<int> rank_of(const std::string& name, TableKind kind) {
    constexpr std::array<std::string_view, 7> order = {"x", "y", "z", "intensity", "red", "green", "blue"};
    const auto at = std::find(order.begin(), order.end(), name);
    const bool is_axis = at < order.begin() + 3;
    if (kind == TableKind::pts)
        return at == order.end() ? std::nullopt : std::optional(static_cast<int>(at - order.begin()));
    return is_axis ? static_cast<int>(at - order.begin()) : 3;
}

void add_list(const NewColumn& column, std::vector<NewNumber>& numbers, std::vector<std::string>& left_out) {
    const auto length = common_length(*column.attribute);
    if (!length || numbers.size() + *length > most_table_columns) {
        left_out.push_back(
            "the lists " + in_quotes(column.name) + " are left out, since " +
            (length ? "they are longer than a table has columns" : "they are not equally long"));
        return;
    }
    for (std::uint64_t place = 0; place < *length; ++place)
        numbers.push_back({column.name + "_" + std::to_string(place + 1), &column, place});
}

std::vector<NewNumber> new_numbers(const std::vector<NewColumn>& columns, TableKind kind,
                                   std::vector<std::string>& left_out) {
    std::vector<const NewColumn*> ordered;
    std::string others;
    for (const NewColumn& column : columns)
        if (rank_of(column.name, kind) && (kind != TableKind::pts || !column.is_list()))
            ordered.push_back(&column);
        else
            others.append(others.empty() ? "" : ", ").append(column.name);
    if (!others.empty())
        left_out.push_back("PTS has only x y z, intensity and red green blue; left out: " + others);
    std::stable_sort(ordered.begin(), ordered.end(), [&](const NewColumn* a, const NewColumn* b) {
        return rank_of(a->name, kind) < rank_of(b->name, kind);
    });
    std::vector<NewNumber> numbers;
    for (const NewColumn* const column : ordered)
        if (column->is_list())
            add_list(*column, numbers, left_out);
        else
            numbers.push_back({column->name, column, 0});
    return numbers;
}

// Whether a reader will know the columns again with no names: x y z, with normals or 8-bit colours behind
// them.
bool speaks_for_itself(const std::vector<NewNumber>& numbers) {
    return std::all_of(numbers.begin(), numbers.end(), [](const NewNumber& number) {
        for (const std::string_view name : {"x", "y", "z", "nx", "ny", "nz"})
            if (number.name == name) return true;
        for (const std::string_view name : {"red", "green", "blue"})
            if (number.name == name) return number.column->type == ScalarType::uint8;
        return false;
    });
}

std::string first_line(const std::vector<NewNumber>& numbers, TableKind kind, std::size_t points) {
    if (kind == TableKind::pts) return std::to_string(points) + '\n';
    if (kind != TableKind::csv && speaks_for_itself(numbers)) return "";
    std::string line = kind == TableKind::csv ? "" : "//";
    for (const NewNumber& number : numbers) {
        if (&number != numbers.data()) line += kind == TableKind::csv ? ',' : ' ';
        line += number.name;
    }
    return line + '\n';
}

} // namespace

std::vector<std::string> write_new_table(FileInTheMaking& file, TableKind kind, const PointCloud& cloud,
                                         const PosedShape& shape, const std::string& shown,
                                         Progress& progress) {
    ColumnsToWrite all = columns_to_write(cloud, shape);
    std::vector<NewColumn>& columns = all.columns;
    name_standard_columns(columns, cloud, {"nx", "ny", "nz"});
    constexpr std::size_t no_limit = 1000;
    std::vector<std::string> left_out = make_names_legal(columns, is_name_letter, no_limit);
    const std::vector<NewNumber> numbers = new_numbers(columns, kind, left_out);
    constexpr std::size_t usual_number = 10; // characters
    BlockWriter out(file, cloud.size() * numbers.size() * usual_number, progress);
    out.append(first_line(numbers, kind, cloud.size()));
    std::string line;
    std::array<char, 64> buffer{};
    for (std::size_t point = 0; point < cloud.size(); ++point) {
        line.clear();
        for (const NewNumber& number : numbers) {
            if (&number != numbers.data()) line += kind == TableKind::csv ? ',' : ' ';
            line.append(buffer.data(), print_new_value(*number.column, point, shown, buffer, number.place));
        }
        out.append(line += '\n');
    }
    out.finish();
    return left_out;
}

} // namespace knead

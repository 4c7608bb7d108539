#include "base/require.h"
#include "io/free_names.h"
#include "io/new_columns.h"
#include "io/patched_copy.h"
#include "io/table.h"
#include "io/table_names.h"
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

// Why the lists of a column cannot become columns behind `taken` others; nothing where they can.
std::optional<std::string> trouble_of_lists(const NewColumn& column, std::size_t taken) {
    const auto length = common_length(*column.attribute);
    if (!length) return "they are not equally long";
    if (*length == 0) return "they are empty";
    if (taken + *length > most_table_columns) return "they are longer than a table has columns";
    return std::nullopt;
}

// Those that have a place in a table of this kind, in their order.
std::vector<const NewColumn*> ordered_columns(const std::vector<NewColumn>& columns, TableKind kind,
                                              std::vector<std::string>& left_out) {
    std::vector<const NewColumn*> ordered;
    std::vector<std::string> others;
    for (const NewColumn& column : columns)
        if (rank_of(column.name, kind) && (kind != TableKind::pts || !column.is_list()))
            ordered.push_back(&column);
        else
            others.push_back(column.name);
    if (!others.empty())
        left_out.push_back(columns_are(others) +
                           " left out, since PTS has only x y z, intensity and red green blue");
    std::stable_sort(ordered.begin(), ordered.end(), [&](const NewColumn* a, const NewColumn* b) {
        return rank_of(a->name, kind) < rank_of(b->name, kind);
    });
    return ordered;
}

// No more than a reader takes, each with a name of its own.
std::vector<NewNumber> new_numbers(const std::vector<const NewColumn*>& columns,
                                   std::vector<std::string>& left_out) {
    std::vector<NewNumber> numbers;
    std::vector<std::string> too_many;
    FreeNames names;
    for (const NewColumn* const column : columns)
        if (!column->is_list()) (void)names.take_exactly(column->name);
    for (const NewColumn* const column : columns) {
        if (!column->is_list()) {
            if (numbers.size() < most_table_columns)
                numbers.push_back({column->name, column, 0});
            else
                too_many.push_back(column->name);
        } else if (const auto trouble = trouble_of_lists(*column, numbers.size())) {
            left_out.push_back("the lists " + in_quotes(column->name) + " are left out, since " + *trouble);
        } else {
            const std::uint64_t length = *common_length(*column->attribute);
            for (std::uint64_t place = 0; place < length; ++place)
                numbers.push_back(
                    {names.take(column->name + "_" + std::to_string(place + 1)), column, place});
        }
    }
    if (!too_many.empty())
        left_out.push_back(columns_are(too_many) + " left out, since a table has at most " +
                           std::to_string(most_table_columns));
    return numbers;
}

// All that the functions below need of a table.
struct NewTable {
    TableKind kind;
    std::vector<NewNumber> numbers; // x y z first
    std::size_t points;
    const std::string& shown;

    std::string_view text(std::size_t column, std::size_t point, std::span<char> buffer) const {
        const NewNumber& number = numbers[column];
        return {buffer.data(), print_new_value(*number.column, point, shown, buffer, number.place)};
    }
};

// Whether a reader will call the columns by their names with no names written: it looks at the same numbers.
bool speaks_for_itself(const NewTable& table) {
    if (table.points == 0) return table.numbers.size() == 3;
    constexpr std::size_t most_guessed = 3 + 3 + 3 + 1; // what is more is no plain scan, and need not be read
    if (table.numbers.size() > most_guessed) return false;
    const auto read_back = [&](std::size_t column, std::size_t point) {
        std::array<char, 64> buffer{};
        double value = 0;
        require(parse_word(table.text(column, point, buffer), ScalarType::float64,
                           reinterpret_cast<std::byte*>(&value)),
                "a number reads back");
        return value;
    };
    return std::ranges::equal(names_by_numbers(table.kind, table.numbers.size(), table.points, read_back),
                              table.numbers, {}, {}, &NewNumber::name);
}

std::string names_line(const NewTable& table) {
    std::string line;
    for (const NewNumber& number : table.numbers)
        line.append(line.empty() ? "" : table.kind == TableKind::csv ? "," : " ").append(number.name);
    return line + '\n';
}

// A count, names, or names in a remark, which programs that know none pass over.
std::string first_line(const NewTable& table) {
    if (table.kind == TableKind::pts) return std::to_string(table.points) + '\n';
    // Without a row, a remark would not make a table of the file.
    if (table.kind == TableKind::csv || table.points == 0) return names_line(table);
    return speaks_for_itself(table) ? "" : "//" + names_line(table);
}

} // namespace

std::vector<std::string> write_new_table(FileInTheMaking& file, TableKind kind, const PointCloud& cloud,
                                         const PosedShape& shape, const std::string& shown,
                                         Progress& progress) {
    ColumnsToWrite all = columns_to_write(cloud, shape);
    std::vector<NewColumn>& columns = all.columns;
    name_standard_columns(columns, cloud, {"nx", "ny", "nz"});
    std::vector<std::string> left_out = make_names_legal(columns, is_name_letter);
    const NewTable table{kind, new_numbers(ordered_columns(columns, kind, left_out), left_out), cloud.size(),
                         shown};
    if (kind == TableKind::pts && !speaks_for_itself(table))
        left_out.emplace_back(
            "PTS names no columns, and by their numbers those behind x y z will be taken for "
            "others than they are; .csv keeps their names");
    constexpr std::size_t usual_number = 10; // characters
    BlockWriter out(file, table.points * table.numbers.size() * usual_number, progress);
    out.append(first_line(table));
    std::string line;
    std::array<char, 64> buffer{};
    for (std::size_t point = 0; point < table.points; ++point) {
        line.clear();
        for (std::size_t column = 0; column < table.numbers.size(); ++column) {
            if (column > 0) line += kind == TableKind::csv ? ',' : ' ';
            line += table.text(column, point, buffer);
        }
        out.append(line += '\n');
    }
    out.finish();
    return left_out;
}

} // namespace knead

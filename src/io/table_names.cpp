#include "io/table_names.h"

#include "base/lower_case.h"
#include "io/free_names.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string_view>

namespace knead {

namespace {

// --- Names of the file -------------------------------------------------------------------------------------

struct Spelling {
    std::string_view standard;
    std::array<std::string_view, 5> others; // in lower case
};

constexpr std::array<Spelling, 8> spellings = {{
    {"nx", {"nx", "normalx", "normal_x", "normals:0", "normal[0]"}},
    {"ny", {"ny", "normaly", "normal_y", "normals:1", "normal[1]"}},
    {"nz", {"nz", "normalz", "normal_z", "normals:2", "normal[2]"}},
    {"red", {"red", "r", "rf", "red", "red"}}, // "Rf" as CloudCompare calls fractions
    {"green", {"green", "g", "gf", "green", "green"}},
    {"blue", {"blue", "b", "bf", "blue", "blue"}},
    {"alpha", {"alpha", "a", "af", "alpha", "alpha"}},
    {"intensity", {"intensity", "i", "intensity", "intensity", "intensity"}},
}};

std::string standard_name(std::string_view name) {
    constexpr std::array<std::string_view, 3> axes = {"x", "y", "z"};
    if (const auto axis = axis_of(name)) return std::string(axes[*axis]);
    const std::string lower = lower_case(std::string(name));
    for (const Spelling& spelling : spellings)
        if (std::find(spelling.others.begin(), spelling.others.end(), lower) != spelling.others.end())
            return std::string(spelling.standard);
    return "";
}

// A name of one word, since that is what columns have in other formats.
std::string one_word(std::string_view name, std::size_t column) {
    std::string word(name.empty() ? "column_" + std::to_string(column + 1) : std::string(name));
    std::replace_if(
        word.begin(), word.end(), [](char c) { return static_cast<unsigned char>(c) <= ' '; }, '_');
    return word;
}

bool is_colour(std::string_view standard) {
    return standard == "red" || standard == "green" || standard == "blue" || standard == "alpha";
}

// The standard name of each column, "" for none. Letters are colours only where all three are there: "a" and
// "b" may as well be angles.
std::vector<std::string> standard_names(const TableLayout& layout) {
    std::vector<std::string> names;
    for (const std::string& name : layout.names) names.push_back(standard_name(name));
    const auto is_named = [&](const char* colour) { return std::ranges::find(names, colour) != names.end(); };
    if (!is_named("red") || !is_named("green") || !is_named("blue"))
        for (std::string& name : names)
            if (is_colour(name)) name.clear();
    return names;
}

void take_names(const TableLayout& layout, std::vector<Attribute>& columns) {
    FreeNames names;
    const std::vector<std::string> standard = standard_names(layout);
    // Standard names go to the first that has a claim, and no other name may be one of those that are taken.
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (!standard[c].empty() && names.take_exactly(standard[c])) columns[c].name = standard[c];
    for (std::size_t c = 0; c < columns.size(); ++c)
        if (columns[c].name.empty()) columns[c].name = names.take(one_word(layout.names[c], c));
}

// --- Names by the numbers ----------------------------------------------------------------------------------

// What all columns are until colours are found.
std::size_t rows_of(const Attribute& column) {
    return column.values.size() / sizeof(double);
}

double number_at(const Attribute& column, std::size_t row) {
    double number = 0;
    std::memcpy(&number, column.values.data() + row * sizeof number, sizeof number);
    return number;
}

bool is_byte(double value) {
    return value >= 0 && value <= 255 && value == std::floor(value);
}

bool is_short(double value) {
    return value >= 0 && value <= 65535 && value == std::floor(value);
}

// A table to be asked what its columns may be.
struct Numbers {
    TableKind kind;
    std::size_t columns, rows;
    const TableNumbers& at;

    bool all_of(std::size_t column, bool (*is_right)(double value)) const {
        for (std::size_t row = 0; row < rows; ++row)
            if (!is_right(at(column, row))) return false;
        return rows > 0;
    }

    // Three columns of what is whole and from 0 to 255.
    bool are_colors(std::size_t column) const {
        if (column + 3 > columns) return false;
        return all_of(column, is_byte) && all_of(column + 1, is_byte) && all_of(column + 2, is_byte);
    }

    // Three columns of vectors of length 1, as far as few digits tell it, or 0 where there was no normal.
    bool are_normals(std::size_t column) const {
        constexpr double rounding = 0.02;
        if (column + 3 > columns) return false;
        bool any = false;
        for (std::size_t row = 0; row < rows; ++row) {
            const Vec3d normal(at(column, row), at(column + 1, row), at(column + 2, row));
            if (normal.isZero(0)) continue;
            if (!(std::abs(normal.norm() - 1) < rounding)) return false;
            any = true;
        }
        return any;
    }

    bool is_opaque(std::size_t column) const {
        return all_of(column, [](double value) { return value == 255; });
    }

    // Behind x y z. An intensity stands alone in a .pts file, or in front of colours; x y z i r g b and x y z
    // r g b a may look alike, and a fourth value that is always 255 is an alpha.
    bool begins_with_intensity() const {
        if (columns == 4) return kind == TableKind::pts;
        if (columns == 7 && are_colors(3) && is_opaque(6)) return false;
        if (are_normals(3)) return false; // of a level floor, 0 0 1, they look like parts of colours
        return columns % 3 == 1 && are_colors(4);
    }
};

// --- Colours -----------------------------------------------------------------------------------------------

template<typename Whole>
void make_whole(Attribute& column, ScalarType type) {
    std::vector<std::byte> values(rows_of(column) * sizeof(Whole));
    for (std::size_t i = 0; i < rows_of(column); ++i) {
        const auto value = static_cast<Whole>(number_at(column, i));
        std::memcpy(values.data() + i * sizeof value, &value, sizeof value);
    }
    column.values = std::move(values);
    column.type = type;
}

// Whole colours as other formats have them; all of them alike.
void type_colors(std::vector<Attribute>& columns) {
    std::vector<Attribute*> colors;
    for (Attribute& column : columns)
        for (const std::string_view name : {"red", "green", "blue", "alpha"})
            if (column.name == name) colors.push_back(&column);
    const auto all = [&](bool (*is_right)(double)) {
        return std::ranges::all_of(colors, [&](const Attribute* column) {
            for (std::size_t row = 0; row < rows_of(*column); ++row)
                if (!is_right(number_at(*column, row))) return false;
            return rows_of(*column) > 0;
        });
    };
    if (all([](double value) { return value <= 1; })) return; // fractions, of the brightest colours only
    const bool bytes = all(is_byte);
    if (!bytes && !all(is_short)) return;
    for (Attribute* const column : colors)
        if (bytes)
            make_whole<std::uint8_t>(*column, ScalarType::uint8);
        else
            make_whole<std::uint16_t>(*column, ScalarType::uint16);
}

} // namespace

std::vector<std::string> names_by_numbers(TableKind kind, std::size_t columns, std::size_t rows,
                                          const TableNumbers& numbers) {
    const Numbers table{kind, columns, rows, numbers};
    std::vector<std::string> names{"x", "y", "z"};
    const auto add = [&](std::initializer_list<const char*> more) {
        names.insert(names.end(), more.begin(), more.end());
    };
    bool has_colors = false;
    bool has_normals = false;
    while (names.size() < columns) {
        const std::size_t at = names.size();
        if (at == 3 && table.begins_with_intensity()) {
            add({"intensity"});
        } else if (!has_normals && table.are_normals(at)) {
            add({"nx", "ny", "nz"});
            has_normals = true;
        } else if (!has_colors && table.are_colors(at)) {
            add({"red", "green", "blue"});
            has_colors = true;
            if (columns == 7 && names.size() == 6 && table.is_opaque(6)) add({"alpha"});
        } else {
            names.push_back("column_" + std::to_string(at + 1));
        }
    }
    return names;
}

std::array<std::size_t, 3> name_table_columns(const TableLayout& layout, TableKind kind,
                                              std::vector<Attribute>& columns) {
    if (layout.names.empty()) {
        const TableNumbers numbers = [&](std::size_t c, std::size_t row) {
            return number_at(columns[c], row);
        };
        const auto names = names_by_numbers(kind, columns.size(), rows_of(columns.front()), numbers);
        for (std::size_t c = 0; c < columns.size(); ++c) columns[c].name = names[c];
    } else {
        take_names(layout, columns);
    }
    type_colors(columns);
    std::array<std::size_t, 3> axes{};
    for (std::size_t c = columns.size(); c-- > 0;)
        for (std::size_t axis = 0; axis < 3; ++axis)
            if (columns[c].name == std::string_view("xyz").substr(axis, 1)) axes[axis] = c;
    return axes;
}

} // namespace knead

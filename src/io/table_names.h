#pragma once
// What the columns of a table are, by the names that its file gives them or else by their numbers.

#include "cloud/point_cloud.h"
#include "io/table.h"

#include <array>
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace knead {

// The number of a table in this column and row, both from 0.
using TableNumbers = std::function<double(std::size_t column, std::size_t row)>;

// The names of columns, 3 at least, that nothing names: told by their numbers, as table.h says. They are
// asked for a column at a time, and only as far as it takes.
std::vector<std::string> names_by_numbers(TableKind kind, std::size_t columns, std::size_t rows,
                                          const TableNumbers& numbers);

// Names the columns (float64, as many and as the layout says, without names yet) and gives whole colours
// their type. The places of x, y and z among them.
std::array<std::size_t, 3> name_table_columns(const TableLayout& layout, TableKind kind,
                                              std::vector<Attribute>& columns);

} // namespace knead

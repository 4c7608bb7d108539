#pragma once
// What the columns of a table are, by the names that its file gives them or else by their numbers.

#include "cloud/point_cloud.h"
#include "io/table.h"

#include <array>
#include <vector>

namespace knead {

// Names the columns (float64, as many and as the layout says, without names yet) and gives whole colours
// their type. The places of x, y and z among them.
std::array<std::size_t, 3> name_table_columns(const TableLayout& layout, TableKind kind,
                                              std::vector<Attribute>& columns);

} // namespace knead

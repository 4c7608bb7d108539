#pragma once
// Tables of text for a terminal, and numbers in the form that they have there.

#include "bench/statistics.h"

#include <string>
#include <vector>

namespace knead {

// Lines of cells. A line of one cell is a heading or a remark: it is written as it is and widens no column.
using TextTable = std::vector<std::vector<std::string>>;

// Columns two spaces apart, the first flush left and the others flush right; cells that a line lacks are
// blank, and no line ends in blanks. Text is UTF-8 of characters one column wide.
std::string format_table(const TextTable& table);

// What stands where a number is not known.
inline constexpr const char* unknown_text = "–";

std::string duration_text(double seconds);         // three digits, in s, ms or µs: "1.03 s"
std::string spread_text(const Summary& seconds);   // the shortest to the longest, in one unit: "4.1…5.0 ms"
std::string factor_text(double factor);            // "312 ×"
std::string digits_text(double value, int digits); // so many behind the point
std::string power_text(double value);              // "2.3e-07", and "0" for zero

} // namespace knead

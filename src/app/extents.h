#pragma once
// Lengths as the panels write them, and how large something is and where.

#include "app/ui.h"

#include <string>

namespace knead {

// A printf format for a length in the file's units that is about as large as `value`: a ten-thousandth of the
// cloud is told apart, as far as there is room for digits before it.
std::string length_format(const Ui& ui, double value);

// "Size: 0.52 × 0.30 × 0.08" and in a second line "Middle: …", of a box in the file's coordinates.
std::string extent_text(const Ui& ui, const Bounds& bounds);
// Of the selected points, or of all where none is, as they are now; while they move, as they were.
std::string shown_extent_text(const Ui& ui);

} // namespace knead

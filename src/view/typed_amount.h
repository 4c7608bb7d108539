#pragma once
// Numbers that are typed in a drag: lengths along the axes that are left to it, degrees, or factors.

#include "view/transform_drag.h"

#include <cstddef>
#include <optional>

namespace knead {

// A character of a number: digits, '.' or ',', '-' (turns the sign round), or of a sum (base/arithmetic.h): +
// * /, and '-' behind these; '\b' takes the last back. Others are not taken: returns false. Degrees in
// rotation, a factor in scale; in translation a length along the axis, and first along x where it is free,
// along the first of a plane's two axes.
bool type_character(TransformDrag& drag, char character);
// The key Tab: the next of these lengths, or the one before; what is typed at that becomes it. Likewise of
// factors, of which there is one for each axis from there on. What is held to one axis, and has its number
// typed, is free then, with that number for that axis. Nothing of a rotation.
void next_field(TransformDrag& drag, bool back);

// Whether the constraint leaves this axis (0 x, 1 y, 2 z) to a shift or a scaling.
bool leaves(const Constraint& constraint, int axis);
// So many numbers can be typed. One factor goes for all axes that are left, until Tab asks for others.
int fields_of(const TransformDrag& drag);
// Which of them is typed at. The constraint may have become another one since.
int field_of(const TransformDrag& drag);
// Whether a number drives, and not the cursor.
bool is_typed(const TransformDrag& drag);
// A number, or what a sum comes to, as far as it is typed: "-" and "." are none yet.
std::optional<double> typed_number(const TransformDrag& drag, std::size_t field = 0);

} // namespace knead

#pragma once
// The axes in the corner of the view: which way the world lies, and a click on one looks along it.

#include "app/ui.h"

#include <optional>

namespace knead {

// Where they stand, if they are shown.
Rectangle axes_place(const Ui& ui);

void draw_axes(const Ui& ui, ImDrawList& list);

// The axis, 0 x, 1 y, 2 z, whose end lies at this place in ImGui's coordinates; nothing: none, or they are
// not shown.
std::optional<int> axis_at(const Ui& ui, ImVec2 place);

// The side from which one looks against this axis; from there, the opposite one.
Side side_of_axis(const Camera& camera, int axis);

} // namespace knead

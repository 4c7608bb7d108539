#pragma once
// The names of the handles in the view.

#include "app/ui.h"

namespace knead {

// Draws them beside the handles and off each other: each with its sign and colour, and with a line to its
// handle where there was no room beside it.
void draw_handle_names(const Ui& ui, ImDrawList& list);

} // namespace knead

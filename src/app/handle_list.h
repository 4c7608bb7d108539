#pragma once
// The list of handles in the panel "Handles", and what the menu of a row offers. Both draw where ImGui is.

#include "app/ui.h"

#include <vector>

namespace knead {

// A row for each, in the order of the list (order_of_list()).
void handle_list(const Ui& ui, const std::vector<Handle>& handles);

// The items of a popup that is open: all that can be done to a handle.
void handle_menu(const Ui& ui, const Handle& handle);

// Of these, along which axis it is mirrored.
void mirror_items(const Ui& ui, const Handle& handle);

} // namespace knead

#pragma once
// What can be done to a handle, as items of a menu. Both draw where ImGui is.

#include "app/ui.h"

namespace knead {

// The items of a popup that is open: all that can be done to a handle.
void handle_menu(const Ui& ui, const Handle& handle);

// Of these, along which axis it is mirrored.
void mirror_items(const Ui& ui, const Handle& handle);

} // namespace knead

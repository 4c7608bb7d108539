#pragma once
// The list of handles in the panel "Handles". It draws where ImGui is.

#include "app/ui.h"

#include <vector>

namespace knead {

// A row for each, in the order of the list (order_of_list()).
void handle_list(const Ui& ui, const std::vector<Handle>& handles);

} // namespace knead

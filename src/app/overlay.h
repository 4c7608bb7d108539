#pragma once
// Where things of the view lie in the window.

#include "app/ui.h"

#include <optional>

namespace knead {

// A pixel of the view, as the camera and the tools count them, in ImGui's coordinates.
ImVec2 in_window(const Ui& ui, glm::dvec2 pixel);

// The names of the handles, beside them and off each other.
void draw_handle_names(const Ui& ui, ImDrawList& list);

} // namespace knead

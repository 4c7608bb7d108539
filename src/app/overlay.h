#pragma once
// Where things of the view lie in the window.

#include "app/ui.h"

#include <optional>

namespace knead {

// A pixel of the view, as the camera and the tools count them, in ImGui's coordinates.
ImVec2 in_window(const Ui& ui, glm::dvec2 pixel);

} // namespace knead

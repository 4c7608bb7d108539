#pragma once
// Where things of the view lie in the window.

#include "app/ui.h"

#include <optional>

namespace knead {

// A pixel of the view, as the camera and the tools count them, in ImGui's coordinates.
ImVec2 in_window(const Ui& ui, glm::dvec2 pixel);

// The middle of the handle's points as they are now, told from some hundred of them.
std::optional<glm::dvec3> middle_of_handle(const Editor& editor, const Handle& handle);

} // namespace knead

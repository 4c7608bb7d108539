#pragma once
// The words beside the cursor of a drag.

#include "view/transform_drag.h"

#include <string>

namespace knead {

// What is done, for beside the cursor: the key, the amount, what it is held to; what was typed stands in
// brackets. "R  45.0°", "G  X 1.250  along world X", "S  × [1.3]  in own YZ",
// "S  ×  X 1.50  Y [2]  Z 1.00".
std::string amount_text(const TransformDrag& drag);

} // namespace knead

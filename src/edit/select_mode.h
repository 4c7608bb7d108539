#pragma once
// What becomes of what is selected, or held, when other points are named.

namespace knead {

enum class SelectMode { replace, add, remove };

} // namespace knead

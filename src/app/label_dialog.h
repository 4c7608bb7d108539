#pragma once
// The dialog that makes handles of an attribute of the file: what it remembers between two frames.

#include "edit/editor_import.h"

#include <optional>
#include <vector>

namespace knead {

struct LabelDialog {
    bool open_now = false; // is to come up in the next frame
    std::vector<LabelColumn> columns;
    std::size_t column = 0;                       // the chosen one
    std::vector<std::optional<HandleRole>> roles; // of each of its values; nothing: no handle
};

// Chooses a column: every value is to be a moving handle but the commonest, which is to be none.
void choose_column(LabelDialog& dialog, std::size_t column);

} // namespace knead

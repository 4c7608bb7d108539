#pragma once
// Names that come from outside, of files and handles, and are shown: they may be in any script.

#include "app/ui.h"

#include <set>

namespace knead {

// Adds those of their letters that the window's own font does not have (app/letters.h).
void add_foreign_letters_of_names(const Editor& editor, const UiState& state, std::set<ImWchar>& letters);

} // namespace knead

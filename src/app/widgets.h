#pragma once
// Small things that several panels are made of.

#include "app/icons.h"

#include <span>
#include <string>

namespace knead {

// A tooltip for the last item, with wrapped lines, after a short rest of the cursor. Shown on disabled items,
// too.
void explain(const char* words);
inline void explain(const std::string& words) {
    explain(words.c_str());
}

// Whether what is laid out now cannot be used.
bool is_disabled();

// A button in the accent's colour: the one that is meant to be pressed.
bool main_button(const char* label, ImVec2 size = {0, 0});

// A button over the whole width, with its key at the right.
bool key_button(const char* label, const char* keys, bool is_main);

// The heading of a part of a panel, which folds it. Returns whether it is open. `unfold`: opens it.
bool section(const char* title, ImFont* font, bool unfold = false);

// A label over the next item, in the second rank's colour.
void caption(const char* words);
// The same to the left of the next item, which begins at `place` from the left of the panel.
void inline_caption(const char* words, float place);

// Text in lines of that width, broken at spaces: a comma stays with its word, an extension with its file's
// name. Words that are wider break where they must.
void wrapped_text(const std::string& words, float width);

// The same as wide as there is room.
void wrapped_text(const std::string& words);

// Text in the second rank's colour, wrapped.
void faint_text(const std::string& words);

// One of several side by side; returns the one clicked, or -1.
int segmented(const char* id, std::span<const char* const> labels, int chosen);

// A shortcut as it is shown: letters on small key caps. Returns its width; draws nothing if `list` is null.
float key_caps(ImDrawList* list, ImVec2 corner, const char* keys);

// "12.4 MB"
std::string byte_size(std::uintmax_t bytes);

// Menus, drop-downs and whatever else is open over the window; there may be nothing.
void close_popups();
// Whether nothing is open above the popup that is being drawn: keys are meant for it.
bool popup_has_keys();

} // namespace knead

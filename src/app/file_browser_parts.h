#pragma once
// Private to this room: what the file browser is put together from.

#include "app/file_browser.h"
#include "app/ui.h"

namespace knead {

// Whether there is room for names and the buttons alone.
bool is_narrow(const Ui& ui);

// Of what is below the list: a caption, or what is wrong in as many lines as it takes and what helps, the
// name, the format of a cloud and what is hidden of it, and the buttons.
float bottom_height(const Ui& ui);
void bottom_row(const Ui& ui, bool hears_keys);

// What the name means is opened, taken or saved; or is gone to where it is a folder. Where that cannot be,
// FileBrowser::trouble says why.
void choose(const Ui& ui);

} // namespace knead

#pragma once
// What the window remembers of its settings from one run to the next, beside the files that were opened last.

#include "view/camera.h"

namespace knead {

// The upward axis that was chosen last; z where none was, or where it cannot be read.
UpAxis read_up_axis();
// A choice that cannot be written is silently not kept.
void remember_up_axis(UpAxis up);

} // namespace knead

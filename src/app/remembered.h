#pragma once
// What the window remembers of its settings from one run to the next, beside the files that were opened last.

#include "view/camera.h"

namespace knead {

struct Remembered {
    UpAxis up = UpAxis::z;          // that was chosen last
    bool choose_samples = true;     // by themselves, of a cloud that is opened afresh
    int width = 1440, height = 900; // of the window, on a display of scale 1
    int panel = 310;                // the width of the panels in it, likewise
};

// The panels are not made narrower than that, nor wider.
inline constexpr int least_panel = 260, most_panel = 640;

// What was never chosen, or cannot be read, is as above.
Remembered read_remembered();
// Choices that cannot be written are silently not kept.
void remember(const Remembered& choices);

} // namespace knead

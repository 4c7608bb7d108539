#pragma once
// What the main loop does for the panels: opening and saving, with the questions that come before.

#include "app/run_editor.h"
#include "app/ui.h"
#include "upsample/drawing.h"

#include <filesystem>
#include <memory>
#include <optional>

namespace knead {

// What lives as long as the window.
struct Work {
    const EditorOptions& options;
    Editor& editor;
    UiState& state;
    bool closing = false;         // the window is to close now
    bool drawn_by_device = false; // whether a graphics card draws, whose memory OpenCL may share
    std::shared_ptr<const GlSharing> sharing = {};     // once a document was opened; null: it does not
    std::optional<std::filesystem::path> picture = {}; // where the view is to be saved once it is drawn
};

void grant(Work& work, const Wish& wish);

// Asks about a save that the document held back.
void ask_about(Work& work, const HeldSave& held);

// Goes on with what waited for a save, once that has succeeded or failed. Call it once a frame.
void go_on_after_saving(Work& work);

} // namespace knead

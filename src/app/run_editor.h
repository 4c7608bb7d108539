#pragma once
// The editor's window, from its opening to its closing.

#include "edit/editor.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace knead {

// Someone who works the window instead of a hand, and looks at what it shows: the benchmark.
struct ShownPicture {
    std::string opengl;       // who drew it
    std::size_t points = 0;   // in it
    bool whole_pixels = true; // or half as many each way
};

class EditorObserver {
public:
    virtual ~EditorObserver() = default;
    // Before events are taken in: what the hand does now, in pixels of the view; the editor may be told more.
    virtual std::vector<Input> play(Editor& editor) = 0;
    // Whether the window is to close.
    virtual bool done() const = 0;
    // A picture of the editor as it is was put on the screen.
    virtual void shown(const Editor& editor, const ShownPicture& picture) = 0;
};

struct EditorOptions {
    std::filesystem::path file;                 // a cloud or a session; empty: begins with nothing open
    std::optional<std::filesystem::path> cloud; // instead of the session's
    std::string device;                         // as make_upsampler() takes it
    unsigned threads = 0;                       // 0: one a core
    int width = 0, height = 0; // of the window, on a display of scale 1; 0: as it was left the last time
    SettingsChange settings;   // of a cloud that is opened
    std::function<bool()> told_to_stop; // by a signal; may be empty
    EditorObserver* observer = nullptr; // not owned
};

// Returns when the user closed the window. Throws Cancelled where it was told to stop, which keeps the
// journal, and Error (usage) where there is no display or no OpenGL 4.1.
void run_editor(const EditorOptions& options);

} // namespace knead

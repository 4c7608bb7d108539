#pragma once
// The window with its OpenGL context and Dear ImGui in it, and what came in by it.

#include "edit/input.h"

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

struct GLFWwindow;

namespace knead {

struct DroppedFiles {
    std::vector<std::filesystem::path> files;
};
struct CloseAsked {};
struct Uncovered {}; // or of another size: what it shows is to be drawn again
// Cursors of Inputs are in the window's own coordinates here; the main loop makes them the view's.
using WindowEvent = std::variant<Input, DroppedFiles, CloseAsked, Uncovered>;

// Owns GLFW, the window, its OpenGL 4.1 core context and the context of Dear ImGui; one at a time.
class Window {
public:
    // Throws Error (usage) where there is no display, or no OpenGL 4.1 on it.
    Window(int width, int height);
    ~Window();
    Window(const Window&) = delete;
    Window& operator=(const Window&) = delete;

    struct Size {
        int width = 0, height = 0;
        bool operator==(const Size&) const = default;
    };
    Size size() const;        // in the coordinates of events and of ImGui
    Size framebuffer() const; // in pixels; 0 while minimised
    float content_scale() const;
    // As a display of scale 1 would have it, and before it filled the screen: what the next one is made of.
    Size size_of_choice() const;

    // Takes in what happened; waits for it up to so many seconds (0: not at all).
    void take_in(double seconds);
    std::vector<WindowEvent> take_events() { return std::exchange(events_, {}); }

    // ImGui's fonts are others from the next frame on.
    void renew_fonts();

    // While that is so, the cursor comes in again on the other side where it leaves the window, and events
    // tell how far it went in all: the hand never comes to an end.
    void set_endless(bool endless);

    // On the whole of the screen that most of the window is on, or where it was before.
    void set_full_screen(bool full);

    // Of ImGui. `mouse_is_taken`: its panels see neither the cursor nor the buttons. `keys_walk`: arrows walk
    // through what is open, Enter and Space choose there.
    void begin_frame(bool mouse_is_taken, bool keys_walk);
    void end_frame(); // draws ImGui's part into the window
    void swap();      // shows what was drawn

    void set_title(const std::string& title);
    std::string drawn_by() const; // "llvmpipe (LLVM 15.0.6, 256 bits)"

private:
    struct Callbacks; // what GLFW calls
    friend struct Callbacks;
    void press(MouseButton button, Modifiers held);
    void look_where_cursor_is();
    void keep_cursor_inside();

    GLFWwindow* window_ = nullptr;
    std::vector<WindowEvent> events_;
    std::string title_;
    struct Place {
        int x = 0, y = 0, width = 0, height = 0;
    };
    std::optional<Place> before_full_screen_;
    glm::dvec2 cursor_{0.0}; // as events tell it
    bool endless_ = false;
    glm::dvec2 gone_round_{0.0}; // how far events are ahead of where the cursor is

    // Keys pressed since the last frame: ImGui looks at the keyboard once a frame, and would miss those that
    // were released again before.
    struct Tapped {
        int key = 0, mods = 0;
    };
    std::vector<Tapped> tapped_;
    std::vector<int> shown_as_down_; // keys of the last frame that had been let go already
    bool has_fonts_ = false;

    // Of the press before, to tell a double click.
    MouseButton last_button_ = MouseButton::left;
    glm::dvec2 last_place_{0.0};
    double last_time_ = -1;
    int clicks_ = 0;
};

} // namespace knead

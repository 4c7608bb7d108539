#include "app/window.h"

#include "app/window_icon.h"
#include "base/error.h"

#include <epoxy/gl.h> // before GLFW, which would bring another loader

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <optional>

namespace knead {

namespace {

constexpr double double_click_seconds = 0.35;
constexpr double double_click_reach = 5; // of the cursor, in the window's coordinates

std::string last_trouble() {
    const char* words = nullptr;
    glfwGetError(&words);
    return words ? words : "no reason was given";
}

Modifiers modifiers_of(int mods) {
    return {(mods & GLFW_MOD_SHIFT) != 0, (mods & GLFW_MOD_CONTROL) != 0, (mods & GLFW_MOD_ALT) != 0};
}

Modifiers held_now(GLFWwindow* window) {
    const auto either = [window](int left, int right) {
        return glfwGetKey(window, left) == GLFW_PRESS || glfwGetKey(window, right) == GLFW_PRESS;
    };
    return {either(GLFW_KEY_LEFT_SHIFT, GLFW_KEY_RIGHT_SHIFT),
            either(GLFW_KEY_LEFT_CONTROL, GLFW_KEY_RIGHT_CONTROL),
            either(GLFW_KEY_LEFT_ALT, GLFW_KEY_RIGHT_ALT)};
}

bool is_modifier(int glfw_key) {
    return glfw_key >= GLFW_KEY_LEFT_SHIFT && glfw_key <= GLFW_KEY_RIGHT_SUPER;
}

// GLFW names a key by its place on a US keyboard. It is taken by what is printed on it, so that Ctrl+Z is
// where the Z is and Ctrl++ where the plus is; but digits that are shortcuts by their place, as Shift is
// needed for them in France.
Key printed_key(int glfw_key, int scancode) {
    const char* name = glfwGetKeyName(glfw_key, scancode);
    const bool is_plain = name && name[0] > ' ' && name[0] < 127 && !name[1];
    const bool is_digit = glfw_key >= GLFW_KEY_0 && glfw_key <= GLFW_KEY_9;
    const bool is_sign = is_plain && std::strchr("+-=,.", name[0]);
    if (!is_plain || (is_digit && (std::strchr("1357", glfw_key) || !is_sign)))
        return key(static_cast<char>(glfw_key));
    return key(static_cast<char>(std::toupper(static_cast<unsigned char>(name[0]))));
}

std::optional<Key> key_of(int glfw_key, int scancode) {
    if (glfw_key > ' ' && glfw_key < 128) return printed_key(glfw_key, scancode);
    if (glfw_key >= GLFW_KEY_ESCAPE && glfw_key <= GLFW_KEY_END)
        return static_cast<Key>(static_cast<int>(Key::escape) + glfw_key - GLFW_KEY_ESCAPE);
    if (glfw_key >= GLFW_KEY_F1 && glfw_key <= GLFW_KEY_F12)
        return static_cast<Key>(static_cast<int>(Key::f1) + glfw_key - GLFW_KEY_F1);
    if (glfw_key >= GLFW_KEY_KP_0 && glfw_key <= GLFW_KEY_KP_9)
        return static_cast<Key>(static_cast<int>(Key::pad_0) + glfw_key - GLFW_KEY_KP_0);
    switch (glfw_key) {
    case GLFW_KEY_KP_ENTER:
        return Key::enter;
    case GLFW_KEY_KP_ADD:
        return key('+');
    case GLFW_KEY_KP_SUBTRACT:
        return key('-');
    case GLFW_KEY_SPACE:
        return key(' ');
    default:
        return std::nullopt;
    }
}

glm::dvec2 cursor_of(GLFWwindow* window) {
    glm::dvec2 place(0.0);
    glfwGetCursorPos(window, &place.x, &place.y);
    return place;
}

// Where a cursor comes in again that leaves a window of so many pixels: it does on its last ones, since it
// may not get beyond those of the screen.
double inside_of(double place, int pixels) {
    constexpr double edge = 1, inwards = 2; // so that it does not leave at once again
    const double last = pixels - 1;
    if (place >= edge && place <= last - edge) return place;
    return place < edge ? last - edge - inwards : edge + inwards;
}

std::optional<MouseButton> button_of(int glfw_button) {
    switch (glfw_button) {
    case GLFW_MOUSE_BUTTON_LEFT:
        return MouseButton::left;
    case GLFW_MOUSE_BUTTON_MIDDLE:
        return MouseButton::middle;
    case GLFW_MOUSE_BUTTON_RIGHT:
        return MouseButton::right;
    default:
        return std::nullopt;
    }
}

} // namespace

struct Window::Callbacks {
    static Window& of(GLFWwindow* window) { return *static_cast<Window*>(glfwGetWindowUserPointer(window)); }

    static void cursor(GLFWwindow* window, double x, double y) {
        Window& self = of(window);
        if (self.endless_) return; // it may be from before the cursor was put elsewhere
        self.cursor_ = {x, y};
        self.events_.emplace_back(Input(MouseMove{self.cursor_, held_now(window)}));
    }
    static void button(GLFWwindow* window, int glfw_button, int action, int mods) {
        const std::optional<MouseButton> which = button_of(glfw_button);
        if (!which) return;
        Window& self = of(window);
        if (self.endless_) self.look_where_cursor_is();
        if (action == GLFW_PRESS)
            self.press(*which, modifiers_of(mods));
        else
            self.events_.emplace_back(Input(MouseRelease{*which, self.cursor_, modifiers_of(mods)}));
    }
    static void scroll(GLFWwindow* window, double /*x*/, double y) {
        Window& self = of(window);
        const glm::dvec2 place = self.cursor_ - self.gone_round_; // where one looks
        if (y != 0) self.events_.emplace_back(Input(Wheel{y, place, held_now(window)}));
    }
    static void key(GLFWwindow* window, int glfw_key, int scancode, int action, int mods) {
        Window& self = of(window);
        if (is_modifier(glfw_key))
            return self.look_where_cursor_is(); // what it does means something else now
        if (action == GLFW_RELEASE) return;
        self.look_where_cursor_is();
        if (glfw_key >= 0) self.tapped_.push_back({glfw_key, mods});
        Modifiers held = modifiers_of(mods);
        held.alt |= glfwGetKey(window, GLFW_KEY_RIGHT_ALT) == GLFW_PRESS; // AltGr: its 5 is no 5
        if (const std::optional<Key> which = key_of(glfw_key, scancode))
            self.events_.emplace_back(Input(KeyPress{*which, held, action == GLFW_REPEAT}));
    }
    static void character(GLFWwindow* window, unsigned code) {
        of(window).events_.emplace_back(Input(Character{static_cast<char32_t>(code)}));
    }
    static void drop(GLFWwindow* window, int count, const char** paths) {
        DroppedFiles dropped;
        for (int i = 0; i < count; ++i) dropped.files.emplace_back(paths[i]);
        of(window).events_.emplace_back(std::move(dropped));
    }
    static void close(GLFWwindow* window) {
        glfwSetWindowShouldClose(window, GLFW_FALSE); // it is asked about first
        of(window).events_.emplace_back(CloseAsked{});
    }
    static void uncover(GLFWwindow* window) { of(window).events_.emplace_back(Uncovered{}); }
    static void focus(GLFWwindow* window, int focused) {
        if (!focused) uncover(window); // no cursor blinks in it
    }
};

// Keys mean what the cursor points at, which tells of its moves alone: not where it was before the first of
// them.
void Window::look_where_cursor_is() {
    cursor_ = cursor_of(window_) + gone_round_;
    events_.emplace_back(Input(MouseMove{cursor_, held_now(window_)}));
}

void Window::set_endless(bool endless) {
    if (endless == endless_) return;
    endless_ = endless;
    gone_round_ = glm::dvec2(0.0);
    look_where_cursor_is();
}

void Window::keep_cursor_inside() {
    if (!glfwGetWindowAttrib(window_, GLFW_FOCUSED)) return;
    const glm::dvec2 place = cursor_of(window_);
    const glm::dvec2 inside(inside_of(place.x, size().width), inside_of(place.y, size().height));
    if (inside != place) glfwSetCursorPos(window_, inside.x, inside.y);
    // There are displays on which nobody may put it elsewhere.
    if (glm::distance(cursor_of(window_), inside) < 1) gone_round_ += place - inside;
    if (cursor_ != cursor_of(window_) + gone_round_) look_where_cursor_is();
}

void Window::press(MouseButton button, Modifiers held) {
    const double now = glfwGetTime();
    const bool again = button == last_button_ && now - last_time_ < double_click_seconds &&
                       glm::distance(cursor_, last_place_) < double_click_reach;
    clicks_ = again ? clicks_ + 1 : 1;
    last_button_ = button;
    last_place_ = cursor_;
    last_time_ = now;
    events_.emplace_back(Input(MousePress{button, cursor_, held, clicks_}));
}

namespace {

GLFWwindow* create_window(int width, int height) {
    if (!glfwInit())
        throw Error(Trouble::usage, "",
                    "there is no display to open a window on (" + last_trouble() +
                        "); `knead replay` and `knead render` need none");
    glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 4);
    glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 1);
    glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
    glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
    glfwWindowHint(GLFW_SCALE_TO_MONITOR, GLFW_TRUE);
    glfwWindowHintString(GLFW_X11_CLASS_NAME, "knead"); // the StartupWMClass of data/desktop/knead.desktop
    glfwWindowHintString(GLFW_X11_INSTANCE_NAME, "knead");
    GLFWwindow* window = glfwCreateWindow(width, height, "knead", nullptr, nullptr);
    if (window) return window;
    const std::string trouble = last_trouble();
    glfwTerminate();
    throw Error(Trouble::usage, "",
                "no window with OpenGL 4.1 could be opened (" + trouble +
                    "); update the graphics driver, or set LIBGL_ALWAYS_SOFTWARE=1 to draw in software");
}

// A window is made as much larger as the display is scaled, and may come out larger than that.
void fit_into_display(GLFWwindow* window, float scale) {
    int width = 0, height = 0, x = 0, y = 0, most_wide = 0, most_high = 0;
    glfwGetWindowSize(window, &width, &height);
    if (GLFWmonitor* monitor = glfwGetPrimaryMonitor())
        glfwGetMonitorWorkarea(monitor, &x, &y, &most_wide, &most_high);
    if (most_wide <= 0 || most_high <= 0) most_wide = width, most_high = height;
    if (width > most_wide || height > most_high)
        glfwSetWindowSize(window, std::min(width, most_wide), std::min(height, most_high));
    const auto least = [&](float pixels, int most) {
        return std::min(static_cast<int>(std::lround(pixels * scale)), most);
    };
    glfwSetWindowSizeLimits(window, least(640, most_wide), least(420, most_high), GLFW_DONT_CARE,
                            GLFW_DONT_CARE);
}

void show_icon(GLFWwindow* window) {
    WindowIcon icon = window_icon();
    const GLFWimage image{icon.size, icon.size, icon.rgba.data()};
    glfwSetWindowIcon(window, 1, &image);
}

} // namespace

Window::Window(int width, int height) : window_(create_window(width, height)) {
    glfwMakeContextCurrent(window_);
    glfwSwapInterval(1);
    glfwSetWindowUserPointer(window_, this);
    fit_into_display(window_, content_scale());
    show_icon(window_);
    glfwGetCursorPos(window_, &cursor_.x, &cursor_.y);
    // Before ImGui's own, which pass everything on to these.
    glfwSetCursorPosCallback(window_, Callbacks::cursor);
    glfwSetMouseButtonCallback(window_, Callbacks::button);
    glfwSetScrollCallback(window_, Callbacks::scroll);
    glfwSetKeyCallback(window_, Callbacks::key);
    glfwSetCharCallback(window_, Callbacks::character);
    glfwSetDropCallback(window_, Callbacks::drop);
    glfwSetWindowCloseCallback(window_, Callbacks::close);
    glfwSetWindowFocusCallback(window_, Callbacks::focus);
    glfwSetWindowRefreshCallback(window_, Callbacks::uncover);
    ImGui::CreateContext();
    ImGui::GetIO().IniFilename = nullptr; // nothing of the layout is kept
    ImGui::GetIO().ConfigDragClickToInputText = true;
    ImGui_ImplGlfw_InitForOpenGL(window_, true);
    ImGui_ImplOpenGL3_Init("#version 410 core");
}

Window::~Window() {
    ImGui_ImplOpenGL3_Shutdown();
    ImGui_ImplGlfw_Shutdown();
    ImGui::DestroyContext();
    glfwDestroyWindow(window_);
    glfwTerminate();
}

Window::Size Window::size() const {
    Size size;
    glfwGetWindowSize(window_, &size.width, &size.height);
    return size;
}

Window::Size Window::framebuffer() const {
    Size size;
    glfwGetFramebufferSize(window_, &size.width, &size.height);
    return size;
}

Window::Size Window::size_of_choice() const {
    const Size now =
        before_full_screen_ ? Size{before_full_screen_->width, before_full_screen_->height} : size();
    const auto unscaled = [&](int pixels) {
        return static_cast<int>(std::lround(static_cast<float>(pixels) / content_scale()));
    };
    return {unscaled(now.width), unscaled(now.height)};
}

float Window::content_scale() const {
    float x = 1, y = 1;
    glfwGetWindowContentScale(window_, &x, &y);
    // Where the framebuffer is finer than the window's coordinates (Wayland, macOS), ImGui scales by itself.
    const Size outer = size(), inner = framebuffer();
    const float finer = outer.width > 0 && inner.width > 0
                            ? static_cast<float>(inner.width) / static_cast<float>(outer.width)
                            : 1;
    return std::max(1.0f, std::max(x, y) / finer);
}

void Window::take_in(double seconds) {
    if (seconds > 0)
        glfwWaitEventsTimeout(seconds);
    else
        glfwPollEvents();
    if (endless_) keep_cursor_inside();
}

namespace {

GLFWmonitor* monitor_at(int x, int y) {
    int count = 0;
    GLFWmonitor** const all = glfwGetMonitors(&count);
    for (int i = 0; i < count; ++i) {
        int left = 0, top = 0;
        glfwGetMonitorPos(all[i], &left, &top);
        const GLFWvidmode* mode = glfwGetVideoMode(all[i]);
        if (mode && x >= left && x < left + mode->width && y >= top && y < top + mode->height) return all[i];
    }
    return glfwGetPrimaryMonitor();
}

} // namespace

void Window::set_full_screen(bool full) {
    if (full == before_full_screen_.has_value()) return;
    if (!full) {
        const Place place = *std::exchange(before_full_screen_, std::nullopt);
        return glfwSetWindowMonitor(window_, nullptr, place.x, place.y, place.width, place.height, 0);
    }
    Place place;
    glfwGetWindowPos(window_, &place.x, &place.y);
    glfwGetWindowSize(window_, &place.width, &place.height);
    GLFWmonitor* const monitor = monitor_at(place.x + place.width / 2, place.y + place.height / 2);
    const GLFWvidmode* mode = monitor ? glfwGetVideoMode(monitor) : nullptr;
    if (!mode) return;
    before_full_screen_ = place;
    glfwSetWindowMonitor(window_, monitor, 0, 0, mode->width, mode->height, mode->refreshRate);
}

void Window::renew_fonts() {
    if (!has_fonts_) return;
    ImGui_ImplOpenGL3_DestroyFontsTexture();
    ImGui_ImplOpenGL3_CreateFontsTexture();
}

// A key that went down and up again between two frames is shown to ImGui as down for one frame. ImGui checks
// that its modifiers do not change within a frame, so it is let go when the next one begins.
void Window::begin_frame(bool mouse_is_taken, bool keys_walk) {
    ImGui_ImplOpenGL3_NewFrame(); // the first makes the fonts' texture
    has_fonts_ = true;
    ImGui_ImplGlfw_NewFrame();
    ImGuiIO& io = ImGui::GetIO();
    if (!shown_as_down_.empty()) {
        for (const int key : shown_as_down_) io.KeysDown[key] = glfwGetKey(window_, key) == GLFW_PRESS;
        shown_as_down_.clear();
        const Modifiers held = held_now(window_);
        io.KeyCtrl = held.ctrl;
        io.KeyShift = held.shift;
        io.KeyAlt = held.alt;
    }
    for (const Tapped& tapped : tapped_) {
        io.KeysDown[tapped.key] = true;
        io.KeyCtrl = (tapped.mods & GLFW_MOD_CONTROL) != 0;
        io.KeyShift = (tapped.mods & GLFW_MOD_SHIFT) != 0;
        io.KeyAlt = (tapped.mods & GLFW_MOD_ALT) != 0;
        shown_as_down_.push_back(tapped.key);
    }
    tapped_.clear();
    io.ConfigFlags = keys_walk ? io.ConfigFlags | ImGuiConfigFlags_NavEnableKeyboard
                               : io.ConfigFlags & ~ImGuiConfigFlags_NavEnableKeyboard;
    // Of itself ImGui takes Space alone.
    if (keys_walk && (io.KeysDown[GLFW_KEY_ENTER] || io.KeysDown[GLFW_KEY_KP_ENTER]))
        io.NavInputs[ImGuiNavInput_Activate] = 1;
    if (mouse_is_taken) {
        io.MousePos = {-FLT_MAX, -FLT_MAX};
        std::ranges::fill(io.MouseDown, false);
    }
    ImGui::NewFrame();
}

void Window::end_frame() {
    ImGui::Render();
    ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

void Window::swap() {
    glfwSwapBuffers(window_);
}

std::string Window::drawn_by() const {
    const auto* words = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    return words ? words : "unknown";
}

void Window::set_title(const std::string& title) {
    if (title == title_) return;
    title_ = title;
    glfwSetWindowTitle(window_, title.c_str());
}

} // namespace knead

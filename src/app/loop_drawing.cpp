// Where things are in the window, and how they are drawn.

#include "app/actions.h"
#include "app/loop.h"
#include "app/remembered.h"
#include "app/timeline.h"
#include "app/widgets.h"
#include "edit/cures.h"
#include "render/png.h"

#include <epoxy/gl.h>

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

// How long nothing has to move until the picture is drawn as finely as it can be.
constexpr double rest_seconds = 0.15;

// How long the processor fills the picture of something that rests with points that are missing, until events
// are looked at again.
constexpr double filling_seconds = 0.02;

// Whether the keys walk through a menu or drop-down; from one menu of the bar to the next they go by
// themselves, and questions have keys of their own.
bool keys_walk(MenuWalk& menus) {
    const auto is_down = [](ImGuiKey key) { return ImGui::IsKeyDown(ImGui::GetKeyIndex(key)); };
    menus.stepped &= is_down(ImGuiKey_LeftArrow) || is_down(ImGuiKey_RightArrow);
    if (menus.step != 0) menus.stepped = true;
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel) &&
           !ImGui::GetTopMostPopupModal() && !ImGui::GetIO().WantTextInput && !menus.stepped;
}

float status_height(const Loop& loop) {
    return loop.editor.document ? std::round(28 * loop.state.scale) : 0;
}

float timeline_height(const Loop& loop) {
    return loop.editor.document && loop.state.playback.shown ? std::round(42 * loop.state.scale) : 0;
}

void carry_out_wishes(Loop& loop) {
    carry_out_commands(loop);
    if (!loop.wishes.empty()) bring_cursor(loop);
    for (const Wish& wish : std::exchange(loop.wishes, {})) grant(loop.work, wish);
    go_on_after_saving(loop.work);
}

void show_title(Loop& loop) {
    const Editor& editor = loop.editor;
    if (!editor.document) return loop.window.set_title("knead");
    const std::filesystem::path& session = editor.document->session; // two may be of one cloud
    const std::string name = (session.empty() ? editor.opened.file : session).filename().string();
    loop.window.set_title(name + (has_unsaved_session(editor) ? "*" : "") + " — knead");
}

void draw_panels(Loop& loop) {
    const Ui& ui = loop.ui;
    const Rectangle& view = loop.state.view;
    if (std::exchange(loop.close_menus, false)) close_popups();
    if (std::exchange(loop.ends_typing, false)) ImGui::ClearActiveID();
    loop.tabbed = false;
    draw_menu_bar(ui);
    draw_overlay(ui);
    draw_legend(ui);
    if (loop.editor.document) {
        const auto window = loop.window.size();
        const auto width = static_cast<float>(window.width), height = static_cast<float>(window.height);
        const float below = view.y + view.height;
        draw_tool_column(ui, {0, view.y, view.x, view.height});
        if (loop.state.show_panels)
            draw_side_panels(ui, {view.x + view.width, view.y, width - view.x - view.width, view.height});
        draw_timeline(ui, {0, below, width, timeline_height(loop)});
        draw_status_line(ui, {0, height - status_height(loop), width, status_height(loop)});
    }
    draw_view_menu(ui);
    draw_recovery(ui);
    draw_welcome(ui); // below that
    draw_opening(ui);
    draw_toasts(ui);
    draw_help(ui);
    draw_about(ui);
    draw_file_browser(ui);
    draw_label_dialog(ui);
    draw_dialogs(ui);
}

void clear_to(ImU32 color) {
    const ImVec4 c = as_vector(color);
    glClearColor(c.x, c.y, c.z, 1);
    glClear(GL_COLOR_BUFFER_BIT);
}

// What the panels lie on; they draw no background of their own.
void clear_window(const Loop& loop, const Window::Size& size) {
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
    glViewport(0, 0, size.width, size.height);
    glDisable(GL_SCISSOR_TEST);
    clear_to(loop.editor.document ? palette::panel : palette::window);
    if (loop.editor.document) return;
    const auto menu = static_cast<int>(std::lround(loop.state.view.y * loop.state.pixel_ratio));
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, size.height - menu, size.width, menu);
    clear_to(palette::panel);
    glDisable(GL_SCISSOR_TEST);
}

// Whether the picture to be drawn differs from the one before by a motion, or did a moment ago.
bool moves(Loop& loop) {
    const Editor& editor = loop.editor;
    const double now = ImGui::GetTime();
    if (!(editor.camera == loop.shown_camera) || editor.frame.version != loop.shown_version)
        loop.moved_last = now;
    loop.shown_camera = editor.camera;
    loop.shown_version = editor.frame.version;
    return now - loop.moved_last < rest_seconds;
}

DrawBudget& budget_of(Loop& loop) {
    return loop.editor.status.solving ? loop.dragging : loop.orbiting;
}

PointLook look_of(const UiState& state) {
    PointLook look = state.display.look;
    look.pixel_scale = state.scale * state.pixel_ratio;
    return look;
}

DrawResult draw_scene(Loop& loop, int window_height) {
    if (!loop.editor.document) return {.complete = true};
    loop.scene.take_in(loop.editor, loop.state);
    const PointLook look = look_of(loop.state);
    const DrawBudget& budget = budget_of(loop);
    const bool moving = moves(loop);
    loop.is_coarse = moving && budget.coarse();
    const Rectangle& view = loop.state.view;
    const auto left = static_cast<int>(view.x * loop.state.pixel_ratio);
    const auto top = static_cast<int>(view.y * loop.state.pixel_ratio);
    const Stopwatch clock;
    DrawResult result;
    do
        result = loop.scene.draw(loop.editor, look, budget.points(), loop.is_coarse, left,
                                 window_height - top - loop.editor.viewport.height);
    while (!moving && !result.complete && loop.scene.is_drawn_in_software() &&
           clock.seconds() < filling_seconds);
    return result;
}

// What the view shows, where somebody asked for a picture of it. The window's own comes next, anew.
void save_picture(Loop& loop) {
    const auto file = std::exchange(loop.work.picture, std::nullopt);
    if (!file || !loop.editor.document) return;
    try {
        const Picture picture =
            loop.scene.picture(loop.editor, look_of(loop.state), loop.state.browser.bare_picture);
        write_png(*file, picture);
        add_toast(loop.state, {Notice::Kind::information, "Saved picture " + file->string() + " (" +
                                                              std::to_string(picture.width) + " × " +
                                                              std::to_string(picture.height) + ")"});
    } catch (const std::exception&) { // for a large one there may be no memory
        add_toast(loop.state, {Notice::Kind::error, words_about_exception()});
    }
    loop.frames_to_draw = 3;
}

void measure(Loop& loop, const DrawResult& result, double seconds) {
    Measured& measured = loop.state.measured;
    measured.drawn =
        result.complete ? result.in_view : result.in_view / std::max<std::size_t>(1, result.one_in);
    measured.in_view = result.in_view;
    if (result.complete && !measured.complete) // the status line is to say so
        loop.frames_to_draw = std::max(loop.frames_to_draw, 2);
    measured.complete = result.complete;
    measured.solve = loop.editor.frame.solve;
    measured.upsample = loop.editor.frame.upsample;
    // Only pictures of something that moves: the others have all the time in the world.
    if (result.drawn == 0 || loop.moved_last < ImGui::GetTime()) return;
    // A graphics card draws while the processor goes on: all of its time is taken for that of the points.
    const bool in_software = loop.scene.is_drawn_in_software();
    budget_of(loop).learn(result.drawn, in_software ? result.seconds : seconds, seconds);
    measured.frame = measured.frame > 0 ? 0.8 * measured.frame + 0.2 * seconds : seconds;
}

} // namespace

void lay_out(Loop& loop) {
    const Window::Size window = loop.window.size(), inner = loop.window.framebuffer();
    UiState& state = loop.state;
    state.pixel_ratio =
        window.width > 0 ? static_cast<float>(inner.width) / static_cast<float>(window.width) : 1.0f;
    const float scale = state.scale;
    const float top = state.fonts.text->FontSize + 2 * std::floor(7 * scale);
    const float left = loop.editor.document ? std::round(52 * scale) : 0;
    const float bottom = status_height(loop) + timeline_height(loop);
    const auto width = static_cast<float>(window.width), height = static_cast<float>(window.height);
    const bool has_panels = loop.editor.document && state.show_panels;
    const float right =
        has_panels ? std::round(std::min(state.panel_width * scale, std::max(width / 2, least_panel * scale)))
                   : 0;
    state.view = {left, top, std::max(1.0f, width - left - right), std::max(1.0f, height - top - bottom)};
    loop.editor.viewport = {std::max(1, static_cast<int>(state.view.width * state.pixel_ratio)),
                            std::max(1, static_cast<int>(state.view.height * state.pixel_ratio))};
}

void draw(Loop& loop) {
    const Window::Size size = loop.window.framebuffer();
    if (size.width == 0 || size.height == 0) return;
    const Stopwatch clock;
    loop.window.begin_frame(loop.press_is_hands || hand_is_full(loop), keys_walk(loop.state.menus));
    loop.press_is_hands &= holds_button(loop);
    draw_panels(loop);
    const bool played = loop.state.playback.playing;
    play_on(loop.ui);
    if (played && !loop.state.playback.playing) // the panels have said otherwise
        loop.frames_to_draw = std::max(loop.frames_to_draw, 2);
    carry_out_wishes(loop);
    loop.window.set_full_screen(loop.state.full_screen);
    clear_window(loop, size);
    const bool another_cloud = loop.editor.changes.cloud;
    const DrawResult result = draw_scene(loop, size.height);
    loop.window.end_frame();
    glFinish(); // so that what is measured is the drawing, and not the wait for the display
    if (!another_cloud) measure(loop, result, clock.seconds());
    loop.window.swap();
    save_picture(loop); // when all that is measured has been
    show_title(loop);
}

} // namespace knead

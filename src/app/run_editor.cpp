// The main loop: events to inputs to commands, the panels, the cloud, and sleep while nothing happens.

#include "app/run_editor.h"

#include "app/actions.h"
#include "app/draw_budget.h"
#include "app/recent_files.h"
#include "app/remembered.h"
#include "app/scene.h"
#include "app/shown_names.h"
#include "app/timeline.h"
#include "app/window.h"
#include "app/wishes.h"
#include "base/stopwatch.h"
#include "view/standing.h"

#include <epoxy/gl.h>

#include <imgui_internal.h>

#include <cmath>
#include <set>
#include <utility>

namespace knead {

namespace {

// How long nothing has to move until the picture is drawn as finely as it can be.
constexpr double rest_seconds = 0.15;

// How long the processor fills the picture of something that rests with points that are missing, until events
// are looked at again.
constexpr double filling_seconds = 0.02;

struct Loop {
    explicit Loop(const EditorOptions& chosen)
        : options(chosen), window(chosen.width, chosen.height), editor(chosen.threads) {}

    const EditorOptions& options;
    Window window;
    Editor editor;
    UiState state;
    Scene scene;
    DrawBudget orbiting{1.0 / 33}, dragging{1.0 / 29}; // 30 pictures a second, and more than 24
    Work work{options, editor, state, false, !scene.is_drawn_in_software()};

    std::vector<Command> commands;
    std::vector<Wish> wishes;
    Ui ui{editor, state, commands, wishes};

    std::set<ImWchar> foreign_letters; // that the fonts were loaded with

    glm::dvec2 cursor{0.0};      // of the window, wherever it is
    bool close_menus = false;    // in the next frame
    bool button_is_ours = false; // a press began over the cloud
    bool press_is_hands = false; // and ended what a full hand was doing: no panel is to see it
    int frames_to_draw = 3;      // even if nothing happens: ImGui needs some to settle
    bool opening_before = false;
    Stopwatch calm; // since the last event; ImGui's time stands still while nothing is drawn

    // What the picture shows, to tell whether it moves.
    Camera shown_camera;
    std::uint64_t shown_version = 0;
    double moved_last = -1; // ImGui's time
    bool is_coarse = false; // the picture, which is to be drawn again once it rests
};

// --- Where things are ---

float status_height(const Loop& loop) {
    return loop.editor.document ? std::round(28 * loop.state.scale) : 0;
}

float timeline_height(const Loop& loop) {
    return loop.editor.document && loop.state.playback.shown ? std::round(42 * loop.state.scale) : 0;
}

void lay_out(Loop& loop) {
    const Window::Size window = loop.window.size(), inner = loop.window.framebuffer();
    UiState& state = loop.state;
    state.pixel_ratio =
        window.width > 0 ? static_cast<float>(inner.width) / static_cast<float>(window.width) : 1.0f;
    const float scale = state.scale;
    const float top = state.fonts.text->FontSize + 2 * std::floor(7 * scale);
    const float left = loop.editor.document ? std::round(52 * scale) : 0;
    const float right = loop.editor.document && state.show_panels ? std::round(310 * scale) : 0;
    const float bottom = status_height(loop) + timeline_height(loop);
    const auto width = static_cast<float>(window.width), height = static_cast<float>(window.height);
    state.view = {left, top, std::max(1.0f, width - left - right), std::max(1.0f, height - top - bottom)};
    loop.editor.viewport = {std::max(1, static_cast<int>(state.view.width * state.pixel_ratio)),
                            std::max(1, static_cast<int>(state.view.height * state.pixel_ratio))};
}

// Whether a panel, a card or a menu lies there. Asked of ImGui's windows as they were drawn last, so that it
// is right for every event of a frame and not only for the last one.
bool panel_at(ImVec2 place) {
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows)
        if (window->WasActive && !window->Hidden && !(window->Flags & ImGuiWindowFlags_Tooltip) &&
            !(window->Flags & ImGuiWindowFlags_NoMouseInputs) && window->Rect().Contains(place))
            return true;
    return false;
}

bool popup_is_open() {
    return ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
}

// --- Events ---

glm::dvec2 in_view(const Loop& loop, glm::dvec2 cursor) {
    const UiState& state = loop.state;
    const glm::dvec2 corner(static_cast<double>(state.view.x), static_cast<double>(state.view.y));
    return (cursor - corner) * static_cast<double>(state.pixel_ratio);
}

bool over_cloud(const Loop& loop, glm::dvec2 cursor) {
    const Rectangle& view = loop.state.view;
    const ImVec2 place(static_cast<float>(cursor.x), static_cast<float>(cursor.y));
    return loop.editor.document &&
           ImRect(view.x, view.y, view.x + view.width, view.y + view.height).Contains(place) &&
           !popup_is_open() && !panel_at(place);
}

// What begins by a key or a button begins where the hand is, be that over a panel.
void bring_cursor(Loop& loop) {
    Tools& tools = loop.editor.tools;
    if (tools.doing == Tools::Doing::nothing) tools.cursor = in_view(loop, loop.cursor);
}

// While G, R or S goes on the whole window belongs to it.
bool hand_is_full(const Loop& loop) {
    return loop.editor.tools.drag && loop.editor.tools.modal;
}

void take(Loop& loop, MouseMove event) {
    loop.cursor = event.cursor;
    loop.state.cursor_in_view = over_cloud(loop, event.cursor);
    if (!loop.state.cursor_in_view && !loop.button_is_ours && !hand_is_full(loop)) return;
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

void take(Loop& loop, MousePress event) {
    if (!over_cloud(loop, event.cursor) && !loop.button_is_ours && !hand_is_full(loop)) {
        loop.editor.tools.refused = Tools::Refused::no; // the hand works on a panel
        return;
    }
    loop.button_is_ours = true;
    loop.press_is_hands |= hand_is_full(loop);
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

void take(Loop& loop, MouseRelease event) {
    if (!loop.button_is_ours) return;
    loop.button_is_ours = false;
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

void take(Loop& loop, Wheel event) {
    if (!over_cloud(loop, event.cursor)) return;
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

void take(Loop& loop, const KeyPress& event) {
    // ImGui closes menus by Escape only where the keyboard walks through them. Questions see to it
    // themselves.
    if (event.key == Key::escape && popup_is_open() && !ImGui::GetTopMostPopupModal())
        loop.close_menus = true;
    if (ImGui::GetIO().WantTextInput || popup_is_open()) return;
    if (event.key == Key::escape && loop.state.show_help) return; // closes that
    if (event.key == Key::escape && loop.state.playback.shown && !loop.editor.tools.drag)
        return close_timeline(loop.ui);
    bring_cursor(loop);
    if (loop.editor.document && handle_input(loop.editor, event)) return;
    press_shortcut(loop.ui, event);
}

void take(Loop& loop, const Character& event) {
    if (ImGui::GetIO().WantTextInput || popup_is_open() || !loop.editor.document) return;
    handle_input(loop.editor, event);
}

bool take_events(Loop& loop) {
    const std::vector<WindowEvent> events = loop.window.take_events();
    for (const WindowEvent& event : events) {
        if (const auto* input = std::get_if<Input>(&event))
            std::visit([&](const auto& one) { take(loop, one); }, *input);
        else if (const auto* dropped = std::get_if<DroppedFiles>(&event)) {
            if (!dropped->files.empty()) loop.wishes.emplace_back(WishOpen{dropped->files.front()});
            if (dropped->files.size() > 1)
                add_toast(loop.state,
                          {Notice::Kind::information, "One file at a time: the first is opened."});
        } else if (std::holds_alternative<CloseAsked>(event))
            loop.wishes.emplace_back(WishClose{});
    }
    return !events.empty();
}

// Lets the observer do what the hand would. Returns whether it did anything.
bool be_played(Loop& loop) {
    EditorObserver* observer = loop.options.observer;
    if (!observer) return false;
    const std::vector<Input> inputs = observer->play(loop.editor);
    for (const Input& input : inputs) handle_input(loop.editor, input);
    if (observer->done()) loop.work.closing = true;
    return !inputs.empty();
}

// --- The document ---

// The creature of the demonstration looks along x, whatever was chosen for other clouds: from the front, a
// little from the left and above.
void face_creature(Editor& editor) {
    set_up(editor.camera, UpAxis::z);
    look_at_side(editor.camera, Side::right);
    const auto height = static_cast<double>(editor.viewport.height);
    orbit(editor.camera, Orbiting::turntable, {-0.2 * height, 0.09 * height}, editor.viewport);
}

// Takes in what the document has made. Returns whether anything is new.
bool take_news(Loop& loop) {
    Editor& editor = loop.editor;
    const bool was_opening = editor.opening != nullptr;
    const LiveDocument* before = editor.live.get();
    const bool changed = refresh(editor);
    if (was_opening && !editor.opening && editor.live.get() != before) {
        const OpenRequest& request = editor.opening_request;
        if (request.restore)
            std::erase_if(loop.state.lost,
                          [&](const LostWork& lost) { return lost.journal == *request.restore; });
        else
            remember_file(loop.state.recent, request.file);
        loop.state.handle_colors = {};
        loop.state.overwriting.reset(); // which asked about the document before, as these would
        editor.held_saves.clear();
        loop.state.playback.playing = false;
        loop.state.playback.steps = 0; // where looking began was in the document before
        loop.state.playback.wanted.reset();
        lay_out(loop);
        set_up(editor.camera, standing_axis(editor.frame.positions).value_or(loop.state.display.up));
        if (loop.state.opening_demonstration) face_creature(editor);
        apply(editor, FrameView{FrameWhat::everything});
        loop.frames_to_draw = 3;
    }
    if (changed && editor.document) place_colors(loop.state.handle_colors, editor.document->handles);
    for (Notice& notice : std::exchange(editor.notices, {})) {
        if (notice.kind == Notice::Kind::error) loop.state.after = {}; // what should have been saved was not
        add_toast(loop.state, std::move(notice));
    }
    if (editor.without_cloud) loop.state.without_cloud = std::exchange(editor.without_cloud, std::nullopt);
    if (!editor.held_saves.empty() && !loop.state.overwriting) {
        ask_about(loop.work, editor.held_saves.front());
        editor.held_saves.erase(editor.held_saves.begin());
    }
    return changed || was_opening;
}

void carry_out_wishes(Loop& loop) {
    for (const Command& command : std::exchange(loop.commands, {})) apply(loop.editor, command);
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

// --- Drawing ---

void draw_panels(Loop& loop) {
    const Ui& ui = loop.ui;
    const Rectangle& view = loop.state.view;
    if (std::exchange(loop.close_menus, false)) ImGui::ClosePopupToLevel(0, false);
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

DrawResult draw_scene(Loop& loop, int window_height) {
    if (!loop.editor.document) return {.complete = true};
    loop.scene.take_in(loop.editor, loop.state);
    PointLook look = loop.state.display.look;
    look.pixel_scale = loop.state.scale * loop.state.pixel_ratio;
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

void draw(Loop& loop) {
    const Window::Size size = loop.window.framebuffer();
    if (size.width == 0 || size.height == 0) return;
    const Stopwatch clock;
    loop.window.begin_frame(loop.press_is_hands || hand_is_full(loop));
    loop.press_is_hands &= loop.button_is_ours;
    draw_panels(loop);
    const bool played = loop.state.playback.playing;
    play_on(loop.ui);
    if (played && !loop.state.playback.playing) // the panels have said otherwise
        loop.frames_to_draw = std::max(loop.frames_to_draw, 2);
    carry_out_wishes(loop);
    clear_window(loop, size);
    const bool another_cloud = loop.editor.changes.cloud;
    const DrawResult result = draw_scene(loop, size.height);
    loop.window.end_frame();
    glFinish(); // so that what is measured is the drawing, and not the wait for the display
    if (!another_cloud) measure(loop, result, clock.seconds());
    loop.window.swap();
    show_title(loop);
}

// --- How long to sleep ---

// Seconds until the window has to look again; 0: at once.
double patience(const Loop& loop, bool news) {
    const Editor& editor = loop.editor;
    if (loop.frames_to_draw > 0 || news || !loop.state.measured.complete) return 0;
    if (editor.opening || loop.is_coarse) return 0.03;
    for (const Toast& toast : loop.state.toasts)
        if (toast.shown < 1) return 0;
    if (editor.live && editor.status.busy) return 0.004;
    if (loop.state.sliding.change || loop.scene.expects_more()) return 0.03;
    // Tooltips come a moment after the last motion; a typing cursor blinks; toasts fade.
    if (loop.state.playback.playing || loop.state.playback.wanted) return 0.03;
    const bool restless = loop.calm.seconds() < 1 || ImGui::GetIO().WantTextInput;
    if (restless || !loop.state.toasts.empty()) return 0.12;
    return 0.5;
}

// Whether what was waited for has to be drawn though nothing happened.
bool shows_motion(const Loop& loop) {
    return loop.frames_to_draw > 0 || loop.is_coarse || !loop.state.measured.complete ||
           !loop.state.toasts.empty() || loop.state.sliding.change || loop.scene.expects_more() ||
           loop.state.playback.playing || loop.state.playback.wanted || ImGui::GetIO().WantTextInput ||
           loop.calm.seconds() < 1 || (loop.editor.live && !loop.editor.status.doing.empty());
}

void set_theme(Loop& loop) {
    loop.state.scale = loop.window.content_scale();
    loop.state.fonts = apply_theme(loop.state.scale, loop.foreign_letters);
    loop.window.renew_fonts();
}

// Names may come in any script; what letters they need is known once they are there.
void take_in_letters(Loop& loop) {
    const std::size_t before = loop.foreign_letters.size();
    add_foreign_letters_of_names(loop.editor, loop.state, loop.foreign_letters);
    if (loop.foreign_letters.size() != before) set_theme(loop);
}

} // namespace

void run_editor(const EditorOptions& options) {
    Loop loop(options);
    set_theme(loop);
    loop.state.recent = read_recent_files();
    const Remembered remembered = read_remembered();
    loop.state.display.up = remembered.up;
    loop.state.choose_samples = remembered.choose_samples;
    loop.state.lost = find_lost_work(default_journal_folder());
    if (!options.file.empty()) loop.wishes.emplace_back(WishOpen{options.file, options.cloud, true});
    bool news = true;
    while (!loop.work.closing) {
        if (options.told_to_stop && options.told_to_stop()) return;
        loop.window.take_in(options.observer ? 0.001 : patience(loop, news));
        lay_out(loop);
        const bool played = be_played(loop);
        const bool events = take_events(loop) || played;
        news = take_news(loop);
        if (events) {
            loop.frames_to_draw = 3;
            loop.calm.lap();
        }
        if (!events && !news && !shows_motion(loop)) continue;
        take_in_letters(loop);
        draw(loop);
        if (options.observer)
            options.observer->shown(loop.editor,
                                    {loop.window.drawn_by(), loop.state.measured.drawn, !loop.is_coarse});
        loop.frames_to_draw = std::max(0, loop.frames_to_draw - 1);
    }
    // Whoever closes the window has saved what they wanted to keep.
    if (loop.editor.live) loop.editor.live->discard_journal();
}

} // namespace knead

// Where the hand's events go.

#include "app/actions.h"
#include "app/axes_corner.h"
#include "app/loop.h"
#include "app/overlay.h"
#include "app/timeline.h"

#include <imgui_internal.h>

#include <algorithm>
#include <iterator>
#include <optional>
#include <string_view>

namespace knead {

namespace {

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

} // namespace

void bring_cursor(Loop& loop) {
    Tools& tools = loop.editor.tools;
    if (tools.doing == Tools::Doing::nothing) tools.cursor = in_view(loop, loop.cursor);
}

bool hand_is_full(const Loop& loop) {
    return loop.editor.tools.drag && loop.editor.tools.modal;
}

void carry_out_commands(Loop& loop) {
    for (const Command& command : std::exchange(loop.commands, {})) apply(loop.editor, command);
}

bool holds_button(const Loop& loop) {
    return std::ranges::find(loop.presses, true) != loop.presses.end();
}

namespace {

bool& press_of(Loop& loop, MouseButton button) {
    return loop.presses.at(static_cast<std::size_t>(button));
}

void take(Loop& loop, MouseMove event) {
    loop.cursor = event.cursor;
    loop.state.cursor_in_view = over_cloud(loop, event.cursor);
    if (!loop.state.cursor_in_view && !holds_button(loop) && !hand_is_full(loop)) {
        loop.editor.tools.hovered.reset(); // it is over a panel
        return;
    }
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

// Of those in the corner, where the hand does nothing else and the gizmo does not lie over them.
std::optional<int> axis_clicked(const Loop& loop, const MousePress& press) {
    const bool is_click = press.button == MouseButton::left && press.held == Modifiers{};
    if (!is_click || holds_button(loop) || hand_is_full(loop) || loop.editor.tools.hovered)
        return std::nullopt;
    return axis_at(loop.ui, in_window(loop.ui, press.cursor));
}

// Of the handle whose points lie there, which is chosen.
void open_view_menu(Loop& loop, glm::dvec2 pixel) {
    UiState::ViewMenu& menu = loop.state.view_menu;
    menu = {true, handle_under(loop.editor, pixel)};
    if (!menu.handle.empty()) apply(loop.editor, ChooseHandle{menu.handle});
}

void take(Loop& loop, MousePress event) {
    if (!over_cloud(loop, event.cursor) && !holds_button(loop) && !hand_is_full(loop)) {
        loop.editor.tools.refused = Tools::Refused::no; // the hand works on a panel
        return;
    }
    send_slid_settings(loop.ui);
    carry_out_commands(loop);
    event.cursor = in_view(loop, event.cursor);
    if (const auto axis = axis_clicked(loop, event))
        return apply(loop.editor, LookAtSide{side_of_axis(loop.editor.camera, *axis)});
    press_of(loop, event.button) = true;
    loop.press_is_hands |= hand_is_full(loop);
    const bool is_used = handle_input(loop.editor, event);
    if (event.button == MouseButton::right && !is_used) open_view_menu(loop, event.cursor);
}

void take(Loop& loop, MouseRelease event) {
    if (!std::exchange(press_of(loop, event.button), false)) return;
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

void take(Loop& loop, Wheel event) {
    if (!over_cloud(loop, event.cursor)) return;
    event.cursor = in_view(loop, event.cursor);
    handle_input(loop.editor, event);
}

// From one menu of the bar to the next: by F10, which opens the first, and by the arrows where there is no
// other menu to go into or out of.
bool walks_bar(Loop& loop, const KeyPress& event) {
    MenuWalk& menus = loop.state.menus;
    const bool bar_is_top = menus.open >= 0 && ImGui::GetCurrentContext()->OpenPopupStack.Size == 1;
    const bool opens = event.key == Key::f10 && !hand_is_full(loop) && (menus.open >= 0 || !popup_is_open());
    const bool next = bar_is_top && event.key == Key::right && !menus.at_submenu;
    const bool before = bar_is_top && event.key == Key::left;
    if (opens || next || before) menus.step = before ? -1 : 1;
    return opens || next || before;
}

bool is_typing() {
    return ImGui::GetIO().WantTextInput || types_into_field();
}

// Whether the hand is sliding a field of the panel "Transform", and with it a handle.
bool slides_number(const Loop& loop) {
    const NumberEditing& editing = loop.state.pose_fields.editing;
    return editing.field != 0 && !editing.types && ImGui::GetActiveID() == editing.field;
}

// Ctrl with one of the letters that save, open or close.
bool is_for_file(const KeyPress& event) {
    return event.held.ctrl && !event.held.alt &&
           std::ranges::any_of(std::string_view("SOEQ"),
                               [&](char letter) { return event.key == key(letter); });
}

// Whether the hand draws a lasso or a box, or paints, with the button down.
bool draws_selection(const Loop& loop) {
    return holds_button(loop) && loop.editor.tools.doing == Tools::Doing::selecting;
}

void take(Loop& loop, const KeyPress& event) {
    if (slides_number(loop)) { // the other keys wait
        loop.state.pose_fields.editing.gives_up |= event.key == Key::escape;
        return;
    }
    // ImGui closes menus by Escape only where the keyboard walks through them. Questions see to it
    // themselves.
    if (event.key == Key::escape && popup_is_open() && !ImGui::GetTopMostPopupModal())
        loop.close_menus = true;
    if (walks_bar(loop, event)) return;
    loop.tabbed |= event.key == Key::tab && is_typing();
    if (is_typing() || popup_is_open()) return;
    if (hand_is_full(loop) && is_for_file(event))
        return add_toast(loop.state,
                         {Notice::Kind::information,
                          "First end what the hand does: Enter or a click keeps it, Esc takes it back."});
    if (event.key == Key::escape && loop.state.show_help) return; // closes that
    if (event.key == Key::escape && loop.state.playback.shown && !loop.editor.tools.drag)
        return close_timeline(loop.ui);
    bring_cursor(loop);
    send_slid_settings(loop.ui);
    carry_out_commands(loop);
    if (loop.editor.document && handle_input(loop.editor, event)) return;
    if (draws_selection(loop)) return; // one thing after the other
    press_shortcut(loop.ui, event);
    carry_out_commands(loop); // the next key finds what this one did
}

void take(Loop& loop, const Character& event) {
    if (slides_number(loop) || is_typing() || popup_is_open() || !loop.editor.document) return;
    handle_input(loop.editor, event);
}

void take_event(Loop& loop, const WindowEvent& event) {
    if (const auto* input = std::get_if<Input>(&event))
        std::visit([&](const auto& one) { take(loop, one); }, *input);
    else if (const auto* dropped = std::get_if<DroppedFiles>(&event)) {
        if (!dropped->files.empty()) loop.wishes.emplace_back(WishOpen{dropped->files.front()});
        if (dropped->files.size() > 1)
            add_toast(loop.state, {Notice::Kind::information, "One file at a time: the first is opened."});
    } else if (std::holds_alternative<CloseAsked>(event))
        loop.wishes.emplace_back(WishClose{});
}

// Whether a hand that types goes to the cloud by this, or to a file.
bool leaves_field(const Loop& loop, const Input& input) {
    if (!is_typing() || popup_is_open()) return false;
    if (const auto* press = std::get_if<MousePress>(&input)) return over_cloud(loop, press->cursor);
    const auto* pressed = std::get_if<KeyPress>(&input);
    return pressed && is_for_file(*pressed);
}

// Whether this is about a handle that the document has yet to make, or begins a move, of one or its pivot,
// from where nobody knows yet: an undo takes it back.
bool is_ahead_of_handles(const Editor& editor, const Input& input) {
    const auto* pressed = std::get_if<KeyPress>(&input);
    if (!pressed || pressed->held.ctrl) return false;
    const bool moves = pressed->key == key('G') || pressed->key == key('R') || pressed->key == key('S');
    const bool names = pressed->key == Key::f2;
    if (!(moves && !pressed->held.alt) && !names && pressed->key != key('.')) return false;
    return !editor.tools.drag && !editor.status.playing && handles_may_be_elsewhere(editor);
}

// Whether something has to happen before this event, which is known when the next picture was drawn: what a
// shortcut wished for, what is being typed, or whether it is typed at all.
bool has_to_wait(Loop& loop, const WindowEvent& event) {
    const auto* input = std::get_if<Input>(&event);
    if (!input) return false;
    if (leaves_field(loop, *input)) loop.ends_typing = true;
    if (loop.ends_typing) return true;
    if (std::holds_alternative<MouseMove>(*input) || std::holds_alternative<MouseRelease>(*input))
        return false;
    return !loop.wishes.empty() || loop.tabbed || tab_may_lead_to_field() ||
           is_ahead_of_handles(loop.editor, *input);
}

} // namespace

bool take_events(Loop& loop) {
    constexpr double longest = 3; // seconds: whatever keeps the document busy so long is no reason to wait
    std::vector<WindowEvent> events = std::exchange(loop.waiting, {});
    const bool waited = !events.empty();
    std::ranges::move(loop.window.take_events(), std::back_inserter(events));
    std::size_t taken = 0;
    while (taken < events.size()) {
        const bool is_due = waited && taken == 0 && loop.waits.seconds() > longest;
        if (!is_due && has_to_wait(loop, events[taken])) break;
        take_event(loop, events[taken++]);
    }
    if (taken > 0 || !waited) loop.waits.lap();
    loop.waiting.assign(events.begin() + static_cast<std::ptrdiff_t>(taken), events.end());
    return !events.empty();
}

} // namespace knead

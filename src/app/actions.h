#pragma once
// Everything that the window can do, once: the menus and the help page are made from this table, and so are
// the keys of the window; those that the tools take themselves stand in edit/tools_keys.cpp.

#include "app/ui.h"

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace knead {

struct Shortcut {
    Key key{};
    Modifiers held;
    bool repeats = false; // does it again and again while the key is held
};

struct Action {
    const char* menu;                 // "Edit", or a menu within one: "View/Look from"
    const char* label;                // with "…" where it asks before it does anything
    const char* keys;                 // as shown; empty: none
    const char* words;                // what it does, for the tooltip and the help page
    std::optional<Shortcut> shortcut; // none: the tools take that key themselves, or there is none
    void (*act)(const Ui& ui);
    bool (*possible)(const Ui& ui);
    bool (*ticked)(const Ui& ui) = nullptr;       // null: nothing to tick
    bool line_before = false;                     // a separator in the menu
    std::string (*about)(const Ui& ui) = nullptr; // what it would do now, told in the menu; or null
};

// In the order of the menus.
std::span<const Action> actions();

// The one of this menu with this label.
const Action& action_called(std::string_view menu, std::string_view label);

// An item of the menu that is open, in ImGui.
void menu_item(const Ui& ui, const Action& action);

// Does what a key stands for, if it stands for anything that is possible now. Keys that the tools take
// themselves are not asked about here.
bool press_shortcut(const Ui& ui, const KeyPress& press);

// Keys and movements of the mouse that are no action of a menu, for the help page.
struct Gesture {
    const char* group;
    const char* keys;
    const char* words;
};
std::span<const Gesture> gestures();

} // namespace knead

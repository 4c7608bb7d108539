#pragma once
// What the main loop's files share. Private to this room.

#include "app/draw_budget.h"
#include "app/run_editor.h"
#include "app/scene.h"
#include "app/ui.h"
#include "app/window.h"
#include "app/wishes.h"
#include "base/stopwatch.h"

#include <array>
#include <optional>
#include <set>
#include <vector>

namespace knead {

// All that lives as long as the window.
struct Loop {
    Loop(const EditorOptions& chosen, int width, int height)
        : options(chosen), window(width, height), editor(chosen.threads) {}

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

    glm::dvec2 cursor{0.0};   // of the window, wherever it is
    bool close_menus = false; // in the next frame
    // Events that come after something that the next picture carries out first.
    std::vector<WindowEvent> waiting;
    Stopwatch waits;               // since the first of them began to
    bool tabbed = false;           // since the last frame, in a field: nobody knows whether into another one
    bool ends_typing = false;      // in the next frame: what is being typed counts, the hand goes elsewhere
    std::array<bool, 3> presses{}; // of each button of the mouse: it is down, and went down over the cloud
    bool press_is_hands = false;   // and ended what a full hand was doing: no panel is to see it
    int frames_to_draw = 3;        // even if nothing happens: ImGui needs some to settle
    Stopwatch calm;                // since the last event; ImGui's time stands still while nothing is drawn

    // What the picture shows, to tell whether it moves.
    Camera shown_camera;
    std::uint64_t shown_version = 0;
    double moved_last = -1; // ImGui's time
    bool is_coarse = false; // the picture, which is to be drawn again once it rests
};

// --- loop_events.cpp ---

// Whether a button of the mouse is down that went down over the cloud.
bool holds_button(const Loop& loop);

// Gives the hand's events to what they are meant for: the cloud, the shortcuts, or nobody, where a panel has
// them. Returns whether there were any.
bool take_events(Loop& loop);

// What begins by a key or a button begins where the hand is, be that over a panel.
void bring_cursor(Loop& loop);

// While G, R or S goes on the whole window belongs to it.
bool hand_is_full(const Loop& loop);

// Carries out what panels and shortcuts told the editor.
void carry_out_commands(Loop& loop);

// --- loop_drawing.cpp ---

// Where the panels and the view lie in the window, which may have another size now.
void lay_out(Loop& loop);

// A whole picture: the panels, what they ask for, and the cloud.
void draw(Loop& loop);

} // namespace knead

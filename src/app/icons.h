#pragma once
// The window's icons, drawn as lines so that they are sharp on every display.

#include <imgui.h>

#include <cstdint>

namespace knead {

enum class Icon : std::uint8_t {
    click,
    box,
    lasso,
    polygon,
    brush,
    through, // ways to select
    move,
    rotate,
    scale,
    pivot,
    local,
    world, // transforms
    moving,
    fixed,
    region, // roles of handles
    folder,
    cloud,
    session,
    picture,
    up,
    home, // files
    information,
    warning,
    error,
    close,
    more,
    plus,
    play,
    pause,
    first,
    frame_back,
    frame_on,
    last // of a timeline
};

// Fills a square of `size` pixels about `center`.
void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color);

// A square button with an icon; `on` shows it as chosen. Returns whether it was clicked.
bool icon_button(const char* id, Icon icon, float side, bool on, const char* tooltip);

} // namespace knead

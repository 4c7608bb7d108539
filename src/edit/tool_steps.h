#pragma once
// What the files of the tools share: the steps that inputs are made of. Nobody else's business.

#include "edit/tools.h"

namespace knead {

struct Hand {
    Tools& tools;
    const ToolContext& context;
    std::vector<Command>& commands;

    void tell(Command command) const { commands.push_back(std::move(command)); }
};

// Whether the camera follows the hand, in the middle of a drag or not.
bool moves_camera(const Tools& tools);
// Whether the corners of a polygon are being clicked.
bool draws_polygon(const Tools& tools);
// Whether a click that selects nothing else puts the pivot there.
bool clicks_place_pivot(const Hand& hand);

// --- tools_transform.cpp ---

void begin_drag(const Hand& hand, const GizmoPart& part, bool modal);
void drag_to_cursor(const Hand& hand, glm::dvec2 cursor, Modifiers held);
void end_drag(Tools& tools, std::vector<Command>& commands);
void cancel_drag(Tools& tools, std::vector<Command>& commands);
void drag_key(const Hand& hand, const KeyPress& press);
void drag_character(const Hand& hand, const Character& character);

// --- tools_select.cpp ---

void begin_band(const Hand& hand, Modifiers held);
void extend_band(Tools& tools);
void end_band(const Hand& hand);
void drop_band(Tools& tools);
void click_polygon(const Hand& hand, int clicks);
void close_polygon(const Hand& hand);
void band_key(const Hand& hand, const KeyPress& press);

// --- tools_keys.cpp ---

// A key while nothing is going on; returns whether it means anything.
bool idle_key(const Hand& hand, const KeyPress& press);
// The same of a character, which keyboards have in different places.
bool idle_character(Tools& tools, char32_t code);

} // namespace knead

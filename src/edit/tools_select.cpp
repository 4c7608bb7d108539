// The rubber bands: box, lasso, polygon and brush.

#include "edit/tool_steps.h"

#include <utility>

namespace knead {

namespace {

constexpr double click_pixels = 4; // of motion that make a drag of a click
constexpr double band_pixels = 1;  // between points of a path

SelectMode mode_of(Modifiers held) {
    if (held.shift) return SelectMode::add;
    return held.ctrl ? SelectMode::remove : SelectMode::replace;
}

void select_region(const Hand& hand, ScreenRegion region) {
    hand.tell(SelectRegion{std::move(region), hand.tools.band_mode, hand.tools.through});
}

// A stroke adds to those before.
void paint(const Hand& hand) {
    Tools& tools = hand.tools;
    if (tools.band_mode == SelectMode::replace) tools.band_mode = SelectMode::add;
    select_region(hand, ScreenStroke{tools.band, tools.brush_radius});
}

} // namespace

bool clicks_place_pivot(const Hand& hand) {
    return hand.tools.move_pivot && hand.context.gizmo;
}

bool draws_polygon(const Tools& tools) {
    return tools.doing == Tools::Doing::selecting && tools.select == SelectTool::polygon;
}

void begin_band(const Hand& hand, Modifiers held) {
    Tools& tools = hand.tools;
    tools.doing = Tools::Doing::selecting;
    tools.band = {tools.cursor};
    tools.band_mode = mode_of(held);
}

void extend_band(Tools& tools) {
    if (glm::length(tools.cursor - tools.pressed) >= click_pixels) tools.moved = true;
    const bool is_path = tools.select == SelectTool::lasso || tools.select == SelectTool::brush;
    if (is_path && glm::length(tools.cursor - tools.band.back()) >= band_pixels)
        tools.band.push_back(tools.cursor);
}

void end_band(const Hand& hand) {
    Tools& tools = hand.tools;
    if (tools.moved && tools.select == SelectTool::box)
        select_region(hand, ScreenBox{tools.pressed, tools.cursor});
    else if (tools.moved && tools.select == SelectTool::lasso)
        select_region(hand, ScreenPolygon{tools.band});
    else if (!tools.moved && tools.clicks == 2)
        hand.tell(SetPivotUnder{tools.pressed});
    else if (tools.moved && tools.select == SelectTool::brush)
        paint(hand);
    else if (tools.band_mode == SelectMode::replace && clicks_place_pivot(hand))
        hand.tell(SetPivotInside{tools.pressed});
    else if (tools.select == SelectTool::brush)
        hand.tell(SelectPointUnder{tools.pressed, tools.band_mode, tools.brush_radius, tools.through});
    else
        hand.tell(SelectPointUnder{tools.pressed, tools.band_mode});
    drop_band(tools);
}

void drop_band(Tools& tools) {
    tools.band.clear();
    tools.doing = Tools::Doing::nothing;
}

void click_polygon(const Hand& hand, int clicks) {
    Tools& tools = hand.tools;
    if (clicks != 2) {
        tools.band.push_back(tools.cursor);
    } else if (tools.band.size() == 1) {
        // A double click where nothing was drawn yet means what it means with the other tools.
        hand.tell(SetPivotUnder{tools.cursor});
        drop_band(tools);
    } else {
        close_polygon(hand);
    }
}

void close_polygon(const Hand& hand) {
    if (hand.tools.band.size() >= 3) select_region(hand, ScreenPolygon{hand.tools.band});
    drop_band(hand.tools);
}

void band_key(const Hand& hand, const KeyPress& press) {
    Tools& tools = hand.tools;
    const bool takes_back = press.held.ctrl && !press.held.shift && press.key == key('Z');
    if (press.key == Key::escape) return drop_band(tools);
    if (!draws_polygon(tools)) return takes_back ? drop_band(tools) : void();
    if (press.key == Key::enter) return close_polygon(hand);
    if (press.key != Key::backspace && !takes_back) return;
    tools.band.pop_back();
    if (tools.band.empty()) drop_band(tools);
}

} // namespace knead

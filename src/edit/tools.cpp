#include "edit/tools.h"

#include "edit/tool_steps.h"

namespace knead {

using Doing = Tools::Doing;

namespace {

constexpr double zoom_pixels = 20; // of a zooming drag that count as one step of the wheel

bool transforms(const Tools& tools) {
    return tools.doing == Doing::transforming && tools.drag.has_value();
}

// Tells the camera; a transform in the making stays as it is, whatever the camera and the hand do meanwhile.
void tell_camera(const Hand& hand, const Camera& camera) {
    if (camera == hand.context.camera) return;
    if (transforms(hand.tools))
        hold_transform(*hand.tools.drag, hand.tools.cursor, camera, hand.context.viewport);
    hand.tell(MoveCamera{camera});
}

void begin_camera(const Hand& hand, MouseButton button, Modifiers held) {
    Tools& tools = hand.tools;
    tools.camera_move = held.shift ? Doing::panning : held.ctrl ? Doing::zooming : Doing::orbiting;
    tools.button = button;
    tools.hovered.reset();
    if (transforms(tools))
        tools.orbiting_in_drag = true;
    else
        tools.doing = tools.camera_move;
}

void drag_camera(const Hand& hand, glm::dvec2 drag) {
    if (drag == glm::dvec2(0, 0)) return;
    Camera camera = hand.context.camera;
    const Viewport viewport = hand.context.viewport;
    switch (hand.tools.camera_move) {
    case Doing::panning:
        pan(camera, drag, viewport);
        break;
    case Doing::zooming:
        zoom(camera, -drag.y / zoom_pixels, hand.tools.pressed, viewport);
        break;
    default:
        orbit(camera, hand.tools.orbiting, drag, viewport);
        break;
    }
    tell_camera(hand, camera);
}

void end_camera(const Hand& hand) {
    Tools& tools = hand.tools;
    if (transforms(tools)) {
        tools.orbiting_in_drag = false;
        // The hand has moved without the transform, which goes on from here.
        hold_transform(*tools.drag, tools.cursor, hand.context.camera, hand.context.viewport);
    } else {
        tools.doing = Doing::nothing;
    }
}

// Where a press beside them begins a stroke, rings are taken by what is seen of them.
constexpr GizmoReach among_strokes{.rings = 4};

// With Shift or Ctrl held a press would select.
void hover(const Hand& hand, Modifiers held) {
    const ToolContext& context = hand.context;
    hand.tools.hovered.reset();
    if (context.gizmo && !held.shift && !held.ctrl)
        hand.tools.hovered =
            gizmo_part_under(*context.gizmo, context.camera, context.viewport, hand.tools.cursor,
                             hand.tools.select == SelectTool::click ? GizmoReach{} : among_strokes);
}

bool move_to(const Hand& hand, glm::dvec2 cursor, Modifiers held) {
    Tools& tools = hand.tools;
    const glm::dvec2 drag = cursor - tools.cursor;
    tools.cursor = cursor;
    if (drag != glm::dvec2(0.0)) tools.refused = Tools::Refused::no;
    if (moves_camera(tools))
        drag_camera(hand, drag);
    else if (transforms(tools))
        drag_to_cursor(hand, cursor, held);
    else if (tools.doing == Doing::selecting)
        extend_band(tools);
    else
        hover(hand, held);
    return tools.doing != Doing::nothing || tools.hovered;
}

void press_left(const Hand& hand, const MousePress& press) {
    Tools& tools = hand.tools;
    if (transforms(tools)) {
        if (press.held.alt)
            begin_camera(hand, press.button, press.held);
        else
            end_drag(tools, hand.commands);
        return;
    }
    if (draws_polygon(tools)) return click_polygon(hand, press.clicks);
    if (press.held.alt) return begin_camera(hand, press.button, press.held);
    tools.button = press.button;
    tools.clicks = press.clicks;
    tools.moved = false;
    if (tools.hovered)
        begin_drag(hand, GizmoPart(*tools.hovered), false);
    else if (tools.select == SelectTool::polygon && clicks_place_pivot(hand))
        hand.tell(SetPivotInside{tools.cursor});
    else
        begin_band(hand, press.held);
}

bool press_right(const Hand& hand) {
    Tools& tools = hand.tools;
    if (transforms(tools))
        cancel_drag(tools, hand.commands);
    else if (draws_polygon(tools))
        close_polygon(hand);
    else if (tools.doing == Doing::selecting)
        drop_band(tools);
    else
        return tools.doing != Doing::nothing;
    return true;
}

bool take(const Hand& hand, const MouseMove& move) {
    return move_to(hand, move.cursor, move.held);
}

bool take(const Hand& hand, const MousePress& press) {
    Tools& tools = hand.tools;
    tools.refused = Tools::Refused::no;
    move_to(hand, press.cursor, press.held);
    if (moves_camera(tools)) return true; // a second button changes nothing
    if (press.button == MouseButton::right) return press_right(hand);
    // A band is drawn in pixels: the camera stays while it is.
    const bool draws = tools.doing == Doing::selecting && !draws_polygon(tools);
    if (draws || (draws_polygon(tools) && press.button == MouseButton::middle)) return true;
    tools.pressed = press.cursor;
    if (press.button == MouseButton::middle)
        begin_camera(hand, press.button, press.held);
    else
        press_left(hand, press);
    return true;
}

// Of the gizmo. A click on it that moved nothing means what lies behind, where the pivot is to go.
void let_go(const Hand& hand) {
    const bool clicked = does_nothing(hand.tools.sent) && clicks_place_pivot(hand);
    end_drag(hand.tools, hand.commands);
    if (clicked) hand.tell(SetPivotInside{hand.tools.cursor});
}

bool take(const Hand& hand, const MouseRelease& release) {
    Tools& tools = hand.tools;
    move_to(hand, release.cursor, release.held);
    const bool busy = tools.doing != Doing::nothing;
    if (moves_camera(tools) && release.button == tools.button) {
        end_camera(hand);
    } else if (release.button == MouseButton::left && transforms(tools)) {
        if (!tools.modal) let_go(hand);
    } else if (release.button == MouseButton::left && tools.doing == Doing::selecting &&
               !draws_polygon(tools)) {
        end_band(hand);
    }
    if (tools.doing == Doing::nothing) hover(hand, release.held);
    return busy;
}

bool take(const Hand& hand, const Wheel& wheel) {
    if (hand.tools.doing == Doing::selecting) return true;
    Camera camera = hand.context.camera;
    zoom(camera, wheel.steps, wheel.cursor, hand.context.viewport);
    tell_camera(hand, camera);
    return true;
}

bool take(const Hand& hand, const KeyPress& press) {
    Tools& tools = hand.tools;
    if (tools.doing == Doing::nothing) return idle_key(hand, press);
    if (transforms(tools))
        drag_key(hand, press);
    else if (tools.doing == Doing::selecting)
        band_key(hand, press);
    return true;
}

bool take(const Hand& hand, const Character& character) {
    if (hand.tools.doing == Doing::nothing) return idle_character(hand.tools, character.code);
    if (!transforms(hand.tools)) return false;
    drag_character(hand, character);
    return true;
}

} // namespace

bool moves_camera(const Tools& tools) {
    return tools.doing == Doing::orbiting || tools.doing == Doing::panning || tools.doing == Doing::zooming ||
           (transforms(tools) && tools.orbiting_in_drag);
}

bool handle_input(Tools& tools, const ToolContext& context, const Input& input,
                  std::vector<Command>& commands) {
    const Hand hand{tools, context, commands};
    // A drag that someone else took away is over.
    if (tools.doing == Doing::transforming && !tools.drag) tools.doing = Doing::nothing;
    return std::visit([&](const auto& what) { return take(hand, what); }, input);
}

void drop_everything(Tools& tools, std::vector<Command>& commands) {
    if (transforms(tools))
        cancel_drag(tools, commands);
    else if (tools.doing == Doing::selecting)
        drop_band(tools);
    tools.doing = Doing::nothing;
}

} // namespace knead

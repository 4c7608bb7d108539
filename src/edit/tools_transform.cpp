// The gizmo's drags and the modal G, R, S.

#include "edit/tool_steps.h"
#include "view/typed_amount.h"

namespace knead {

namespace {

void tell_transform(const Hand& hand) {
    Tools& tools = hand.tools;
    Transform transform = transform_of(*tools.drag);
    if (do_the_same(transform, tools.sent)) return;
    tools.sent = transform;
    if (tools.drags_pivot)
        hand.tell(SetPivot{transform.pivot + transform.shift, SetPivot::Stage::moving});
    else
        hand.tell(DragTo{transform});
}

void finish(Tools& tools) {
    tools.doing = Tools::Doing::nothing;
    tools.drag.reset();
    tools.modal = tools.orbiting_in_drag = tools.drags_pivot = false;
    tools.hovered.reset();
}

void begin_drag_at(const Hand& hand, const glm::dvec3& center, const GizmoPart& part, bool modal) {
    Tools& tools = hand.tools;
    const Gizmo& gizmo = *hand.context.gizmo;
    const glm::dquat& own = gizmo.local ? gizmo.axes : hand.context.local_axes;
    tools.doing = Tools::Doing::transforming;
    tools.modal = modal;
    tools.orbiting_in_drag = false;
    tools.drags_pivot = tools.move_pivot && part.kind == TransformKind::translate;
    tools.drag =
        begin_transform(part.kind, center, own, tools.cursor, hand.context.camera, hand.context.viewport);
    tools.drag->constraint = part.constraint;
    tools.drag->own_first = gizmo.local;
    tools.sent = transform_of(*tools.drag);
    if (modal)
        tools.hovered.reset();
    else
        tools.hovered = part;
    if (!tools.drags_pivot) hand.tell(BeginDrag{center});
}

} // namespace

void begin_drag(const Hand& hand, const GizmoPart& part, bool modal) {
    begin_drag_at(hand, hand.context.gizmo->center, part, modal);
}

void drag_to_cursor(const Hand& hand, glm::dvec2 cursor, Modifiers held) {
    TransformDrag& drag = *hand.tools.drag;
    drag.snap = held.ctrl;
    follow_cursor(drag, cursor, held.shift, hand.context.camera, hand.context.viewport);
    tell_transform(hand);
}

void end_drag(Tools& tools, std::vector<Command>& commands) {
    const bool gives_up = does_nothing(tools.sent);
    if (tools.drags_pivot && !gives_up)
        commands.push_back(SetPivot{tools.sent.pivot + tools.sent.shift});
    else if (tools.drags_pivot)
        commands.push_back(SetPivot{{}, SetPivot::Stage::given_up});
    else if (gives_up)
        commands.push_back(CancelDrag{});
    else
        commands.push_back(EndDrag{});
    finish(tools);
}

void cancel_drag(Tools& tools, std::vector<Command>& commands) {
    if (tools.drags_pivot)
        commands.push_back(SetPivot{{}, SetPivot::Stage::given_up});
    else
        commands.push_back(CancelDrag{});
    finish(tools);
}

namespace {

std::optional<TransformKind> kind_of(Key pressed) {
    if (pressed == key('G')) return TransformKind::translate;
    if (pressed == key('R')) return TransformKind::rotate;
    if (pressed == key('S')) return TransformKind::scale;
    return std::nullopt;
}

// What was begun by G goes on as R or S, from where the handle was when it began.
void go_on_as(const Hand& hand, TransformKind kind) {
    TransformDrag& drag = *hand.tools.drag;
    const Gizmo& gizmo = *hand.context.gizmo;
    if (drag.kind == kind) return;
    if (!has_effect(gizmo, kind)) return hand.tell(RefuseTransform{kind});
    if (hand.tools.move_pivot) { // from the pivot to the handle, or the other way round
        const glm::dvec3 center = drag.pivot;
        cancel_drag(hand.tools, hand.commands);
        return begin_drag_at(hand, center, {kind, {}}, true);
    }
    drag = begin_transform(kind, drag.pivot, drag.local_axes, hand.tools.cursor, hand.context.camera,
                           hand.context.viewport);
    drag.own_first = gizmo.local;
    tell_transform(hand);
}

} // namespace

void drag_key(const Hand& hand, const KeyPress& press) {
    TransformDrag& drag = *hand.tools.drag;
    if (press.key == Key::backspace) {
        type_character(drag, '\b');
        tell_transform(hand);
        return;
    }
    if (press.repeated) return;
    const bool takes_back = press.held.ctrl && press.key == key('Z'); // what is going on, that is
    if (press.key == Key::escape || takes_back) return cancel_drag(hand.tools, hand.commands);
    if (press.key == Key::enter) return end_drag(hand.tools, hand.commands);
    if (press.key == Key::tab) {
        next_field(drag, press.held.shift);
        return tell_transform(hand);
    }
    if (const auto kind = kind_of(press.key); kind && hand.tools.modal && press.held == Modifiers{})
        return hand.context.gizmo ? go_on_as(hand, *kind) : void();
    const int axis = static_cast<int>(press.key) - static_cast<int>('X');
    if (axis < 0 || axis > 2) return;
    press_axis(drag, axis, press.held.shift);
    tell_transform(hand);
}

void drag_character(const Hand& hand, const Character& character) {
    const bool printable = character.code >= U' ' && character.code < 127;
    if (printable && type_character(*hand.tools.drag, static_cast<char>(character.code)))
        tell_transform(hand);
}

} // namespace knead

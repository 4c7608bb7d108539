// What the keys mean while the hand does nothing else.

#include "edit/tool_steps.h"

#include <algorithm>
#include <array>
#include <utility>

namespace knead {

namespace {

constexpr Modifiers plain{};
constexpr Modifiers shift{true, false, false};
constexpr Modifiers ctrl{false, true, false};
constexpr Modifiers alt{false, false, true};
constexpr Modifiers ctrl_shift{true, true, false};

struct Shortcut {
    Key key;
    Modifiers held;
    Command command;
};

// Everything that is one command, whatever the tools are doing.
const std::array<Shortcut, 28>& shortcuts() {
    static const std::array<Shortcut, 28> all{{
        {key('A'), plain, ChangeSelection{SelectionStep::all}},
        {key('A'), alt, ChangeSelection{SelectionStep::none}},
        {Key::escape, plain, DropChoice{}},
        {key('I'), ctrl, ChangeSelection{SelectionStep::invert}},
        {key('='), ctrl, ChangeSelection{SelectionStep::grow}},
        {key('='), ctrl_shift, ChangeSelection{SelectionStep::grow}}, // the plus of a US keyboard
        {key('+'), ctrl, ChangeSelection{SelectionStep::grow}},
        {key('+'), ctrl_shift, ChangeSelection{SelectionStep::grow}},
        {key('-'), ctrl, ChangeSelection{SelectionStep::shrink}},
        {key('L'), plain, ChangeSelection{SelectionStep::connected}},
        {key('V'), plain, ChangeHidden{HideStep::hide_selected}},
        {key('V'), shift, ChangeHidden{HideStep::hide_unselected}},
        {key('V'), alt, ChangeHidden{HideStep::show_all}},
        {key('H'), plain, MakeHandle{HandleRole::moving, {}}},
        {key('H'), shift, MakeHandle{HandleRole::fixed, {}}},
        {key('H'), ctrl, MakeHandle{HandleRole::region_of_interest, {}}},
        {key('F'), plain, FrameView{FrameWhat::selection}},
        {Key::home, plain, FrameView{FrameWhat::everything}},
        {key('1'), plain, LookAtSide{Side::front}},
        {key('1'), ctrl, LookAtSide{Side::back}},
        {key('3'), plain, LookAtSide{Side::right}},
        {key('3'), ctrl, LookAtSide{Side::left}},
        {key('7'), plain, LookAtSide{Side::top}},
        {key('7'), ctrl, LookAtSide{Side::bottom}},
        {Key::enter, plain, CommitPose{}},
        {key('Z'), ctrl, UndoStep{}},
        {key('Z'), ctrl_shift, RedoStep{}},
        {key('Y'), ctrl, RedoStep{}},
    }};
    return all;
}

// Keypad digits mean what the others do.
Key without_pad(Key pressed) {
    const int digit = static_cast<int>(pressed) - static_cast<int>(Key::pad_0);
    return digit >= 0 && digit <= 9 ? key(static_cast<char>('0' + digit)) : pressed;
}

// Holding such a key down does it again and again.
bool repeats(const Command& command) {
    if (const auto* change = std::get_if<ChangeSelection>(&command))
        return change->step == SelectionStep::grow || change->step == SelectionStep::shrink;
    return std::holds_alternative<UndoStep>(command) || std::holds_alternative<RedoStep>(command);
}

bool command_key(const Hand& hand, Key pressed, const KeyPress& press) {
    const auto& all = shortcuts();
    const auto found = std::ranges::find_if(all, [&](const Shortcut& shortcut) {
        return shortcut.key == pressed && shortcut.held == press.held;
    });
    if (found == all.end()) return false;
    if (!press.repeated || repeats(found->command)) hand.tell(found->command);
    return true;
}

bool begin_modal(const Hand& hand, TransformKind kind, bool repeated) {
    if (repeated) return true;
    if (hand.context.gizmo && has_effect(*hand.context.gizmo, kind)) {
        begin_drag(hand, {kind, {}}, true);
    } else {
        hand.tools.refused = Tools::Refused::just_now;
        hand.tell(RefuseTransform{kind});
    }
    return true;
}

// Whether it would go on with an amount that is typed.
bool is_of_an_amount(Key pressed) {
    const int code = static_cast<int>(pressed);
    return (code >= '0' && code <= '9') || (code >= 'X' && code <= 'Z') || pressed == key('-') ||
           pressed == key('.') || pressed == key(',') || pressed == Key::backspace;
}

// Whether a key belongs to what was refused, and so means nothing. Tab goes to another handle as long as
// nothing was typed.
bool is_refused(Tools& tools, Key pressed, Modifiers held) {
    const Tools::Refused before = std::exchange(tools.refused, Tools::Refused::no);
    if (before == Tools::Refused::no || held.ctrl || held.alt) return false;
    if (pressed == Key::enter || pressed == Key::escape) return true;
    const bool next_length = pressed == Key::tab && before == Tools::Refused::typed_on;
    if (!is_of_an_amount(pressed) && !next_length) return false;
    tools.refused = Tools::Refused::typed_on;
    return true;
}

bool choose(Tools& tools, SelectTool tool) {
    tools.select = tool;
    return true;
}

// What changes the tools themselves, begins something, or needs the present camera.
bool tool_key(const Hand& hand, Key pressed, bool repeated) {
    Tools& tools = hand.tools;
    switch (static_cast<int>(pressed)) {
    case 'G':
        return begin_modal(hand, TransformKind::translate, repeated);
    case 'R':
        return begin_modal(hand, TransformKind::rotate, repeated);
    case 'S':
        return begin_modal(hand, TransformKind::scale, repeated);
    case 'C':
        return choose(tools, SelectTool::click);
    case 'B':
        return choose(tools, SelectTool::box);
    case 'Q':
        return choose(tools, SelectTool::lasso);
    case 'P':
        return choose(tools, SelectTool::polygon);
    case 'K':
        return choose(tools, SelectTool::brush);
    case 'T':
        if (!repeated) tools.through = !tools.through;
        return true;
    case '5': {
        Camera camera = hand.context.camera;
        camera.orthographic = !camera.orthographic;
        if (!repeated) hand.tell(MoveCamera{camera});
        return true;
    }
    default:
        return false;
    }
}

bool resize_brush(Tools& tools, double factor) {
    tools.brush_radius = std::clamp(tools.brush_radius * factor, 2.0, 500.0);
    return true;
}

} // namespace

bool idle_key(const Hand& hand, const KeyPress& press) {
    const Key pressed = without_pad(press.key);
    if (is_refused(hand.tools, pressed, press.held)) return true;
    if (pressed == Key::escape && std::exchange(hand.tools.move_pivot, false)) return true;
    if (command_key(hand, pressed, press)) return true;
    return press.held == plain && tool_key(hand, pressed, press.repeated);
}

// Brackets are characters, as many keyboards have them on keys of something else.
bool idle_character(Tools& tools, char32_t code) {
    if (code == U'[') return resize_brush(tools, 1 / 1.2);
    return code == U']' && resize_brush(tools, 1.2);
}

} // namespace knead

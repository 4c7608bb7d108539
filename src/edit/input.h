#pragma once
// What the hand did, in plain values: the window turns its events into these, and tests make them up.

#include "view/camera.h"

#include <cstdint>
#include <variant>

namespace knead {

enum class MouseButton : std::uint8_t { left, middle, right };

struct Modifiers {
    bool shift = false, ctrl = false, alt = false;
    bool operator==(const Modifiers&) const = default;
};

// Keys by what is printed on them: letters in upper case, digits and signs as their ASCII code, the others as
// here.
enum class Key : int {
    escape = 256,
    enter,
    tab,
    backspace,
    insert,
    del,
    right,
    left,
    down,
    up,
    page_up,
    page_down,
    home,
    end,
    f1,
    f2,
    f3,
    f4,
    f5,
    f6,
    f7,
    f8,
    f9,
    f10,
    f11,
    f12,
    pad_0 = 320,
    pad_1,
    pad_2,
    pad_3,
    pad_4,
    pad_5,
    pad_6,
    pad_7,
    pad_8,
    pad_9
};
constexpr Key key(char letter_or_digit) {
    return static_cast<Key>(letter_or_digit);
}

struct MouseMove {
    glm::dvec2 cursor{0.0}; // framebuffer pixels
    Modifiers held;
};
struct MousePress {
    MouseButton button = MouseButton::left;
    glm::dvec2 cursor{0.0};
    Modifiers held;
    int clicks = 1; // 2: the second press of a double click
};
struct MouseRelease {
    MouseButton button = MouseButton::left;
    glm::dvec2 cursor{0.0};
    Modifiers held;
};
struct Wheel {
    double steps = 0; // > 0: away from the hand
    glm::dvec2 cursor{0.0};
    Modifiers held;
};
struct KeyPress {
    Key key{};
    Modifiers held;
    bool repeated = false;
};
struct Character {
    char32_t code = 0;
};
using Input = std::variant<MouseMove, MousePress, MouseRelease, Wheel, KeyPress, Character>;

} // namespace knead

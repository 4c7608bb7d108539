#include "view/amount_text.h"

#include "view/typed_amount.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <numbers>

namespace knead {

namespace {

// Never "-0.00".
std::string number(double value, int decimals) {
    char text[64];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    const bool is_zero = std::strpbrk(text, "123456789") == nullptr;
    return is_zero && text[0] == '-' ? text + 1 : text;
}

char letter(int axis) {
    return "XYZ"[axis];
}

// " along own X", " in world YZ", or nothing where it is free.
std::string constraint_words(const TransformDrag& drag, const char* axis_word) {
    if (drag.constraint.kind == Constraint::Kind::free)
        return drag.constraint.local ? "  along own axes" : "";
    const std::string whose = drag.constraint.local ? "own " : "world ";
    const int axis = drag.constraint.axis;
    if (drag.constraint.kind == Constraint::Kind::axis || drag.kind == TransformKind::rotate)
        return "  " + std::string(axis_word) + " " + whose + letter(axis);
    return "  in " + whose + letter(axis == 0 ? 1 : 0) + letter(axis == 2 ? 1 : 2);
}

// What is being typed is seen to be a field.
std::string typed_text(const TransformDrag& drag, std::size_t field = 0) {
    return "[" + drag.typed[field] + "]";
}

// With what a factor comes to that is too small to be taken.
std::string typed_factor_text(const TransformDrag& drag, std::size_t field = 0) {
    const bool is_less = typed_number(drag, field).value_or(1) < least_factor;
    return typed_text(drag, field) + (is_less ? " is " + number(least_factor, 2) : "");
}

// With what an angle comes to that is too large to be taken.
std::string typed_angle_text(const TransformDrag& drag) {
    const double angle = transform_of(drag).angle, taken = within_turns(angle);
    return typed_text(drag) + (taken != angle ? " is " + number(taken * 180 / std::numbers::pi, 1) : "");
}

// One number for each axis that is left, with its letter. Which of them is typed at is seen as soon as there
// is a choice.
template<typename Typed>
std::string numbers_text(const TransformDrag& drag, const glm::dvec3& parts, int decimals, Typed&& typed) {
    const bool begun = is_typed(drag) || field_of(drag) > 0;
    std::string text;
    int field = 0;
    for (int axis = 0; axis < 3; ++axis) {
        if (!leaves(drag.constraint, axis)) continue;
        const auto at = static_cast<std::size_t>(field);
        const bool as_typed = !drag.typed[at].empty() || (begun && field == field_of(drag));
        text +=
            std::string("  ") + letter(axis) + " " + (as_typed ? typed(at) : number(parts[axis], decimals));
        ++field;
    }
    return text;
}

// Lengths are told to a hundredth of the grid.
std::string lengths_text(const TransformDrag& drag) {
    const int decimals =
        drag.grid > 0 ? std::clamp(static_cast<int>(std::ceil(1.5 - std::log10(drag.grid))), 0, 9) : 3;
    const glm::dquat frame = drag.constraint.local ? drag.local_axes : glm::dquat(1, 0, 0, 0);
    return numbers_text(drag, glm::conjugate(frame) * transform_of(drag).shift, decimals,
                        [&](std::size_t field) { return typed_text(drag, field); });
}

std::string factors_text(const TransformDrag& drag) {
    const glm::dvec3 factors = transform_of(drag).scale;
    if (!drag.each_axis) {
        const int axis = leaves(drag.constraint, 0) ? 0 : leaves(drag.constraint, 1) ? 1 : 2; // all alike
        return " " + (is_typed(drag) ? typed_factor_text(drag) : number(factors[axis], 2));
    }
    return numbers_text(drag, factors, 2, [&](std::size_t field) { return typed_factor_text(drag, field); });
}

} // namespace

std::string amount_text(const TransformDrag& drag) {
    const bool typed = is_typed(drag);
    switch (drag.kind) {
    case TransformKind::translate:
        return "G" + lengths_text(drag) + constraint_words(drag, "along");
    case TransformKind::rotate:
        return "R  " +
               (typed ? typed_angle_text(drag)
                      : number(transform_of(drag).angle * 180 / std::numbers::pi, 1)) +
               "°" + constraint_words(drag, "about");
    case TransformKind::scale:
        break;
    }
    return "S  ×" + factors_text(drag) + constraint_words(drag, "along");
}

} // namespace knead

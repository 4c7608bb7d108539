#include "view/typed_amount.h"

#include "base/arithmetic.h"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t longest_sum = 24; // characters

// What is held to one axis is free again, and its number that of this axis.
void leave_axis(TransformDrag& drag) {
    const int axis = drag.constraint.axis;
    drag.constraint = {Constraint::Kind::free, 0, drag.constraint.local};
    std::array<std::string, 3> lengths;
    lengths[static_cast<std::size_t>(axis)] = std::move(drag.typed[0]);
    drag.typed = std::move(lengths);
    drag.field = axis;
}

} // namespace

bool leaves(const Constraint& constraint, int axis) {
    if (constraint.kind == Constraint::Kind::free) return true;
    return (axis == constraint.axis) == (constraint.kind == Constraint::Kind::axis);
}

int fields_of(const TransformDrag& drag) {
    if (drag.kind == TransformKind::rotate || (drag.kind == TransformKind::scale && !drag.each_axis))
        return 1;
    int count = 0;
    for (int axis = 0; axis < 3; ++axis) count += leaves(drag.constraint, axis) ? 1 : 0;
    return count;
}

bool is_typed(const TransformDrag& drag) {
    const auto numbers = std::span(drag.typed).first(static_cast<std::size_t>(fields_of(drag)));
    return std::ranges::any_of(numbers, [](const std::string& number) { return !number.empty(); });
}

std::optional<double> typed_number(const TransformDrag& drag, std::size_t field) {
    const auto sum = sum_of(drag.typed[field]);
    return sum ? std::optional(sum->value) : std::nullopt;
}

int field_of(const TransformDrag& drag) {
    return std::min(drag.field, fields_of(drag) - 1);
}

bool type_character(TransformDrag& drag, char character) {
    drag.field = field_of(drag);
    std::string& typed = drag.typed[static_cast<std::size_t>(drag.field)];
    const bool digit = character >= '0' && character <= '9';
    const bool point = character == '.' || character == ',';
    const std::size_t operation = typed.find_last_of("+*/");
    const bool is_sum = operation != std::string::npos;
    if (character == '-' && !is_sum) {
        if (typed.starts_with('-'))
            typed.erase(0, 1);
        else
            typed.insert(0, 1, '-');
    } else if (character == '\b') {
        if (!typed.empty()) typed.pop_back();
    } else if (digit || point) {
        const std::size_t begin = is_sum ? operation : 0; // of the number that is being typed
        const bool second_point = point && typed.find('.', begin) != std::string::npos;
        if (typed.size() < longest_sum && !second_point) typed.push_back(point ? '.' : character);
    } else if (character == '+' || character == '*' || character == '/' || character == '-') {
        // Behind a number; the sign of the next one may stand behind another.
        const bool behind_number =
            !typed.empty() && typed.find_first_of("+*/-", typed.size() - 1) == std::string::npos;
        if (typed.size() < longest_sum && (behind_number || character == '-')) typed.push_back(character);
    } else {
        return false;
    }
    return true;
}

void next_field(TransformDrag& drag, bool back) {
    if (drag.kind == TransformKind::rotate) return;
    if (drag.constraint.kind == Constraint::Kind::axis && is_typed(drag)) leave_axis(drag);
    drag.each_axis = drag.kind == TransformKind::scale;
    const int count = fields_of(drag);
    drag.field = (field_of(drag) + (back ? count - 1 : 1)) % count;
}

} // namespace knead

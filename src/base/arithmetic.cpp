#include "base/arithmetic.h"

#include <charconv>
#include <cmath>
#include <system_error>

namespace knead {

namespace {

void skip_spaces(std::string_view& text) {
    while (text.starts_with(' ')) text.remove_prefix(1);
}

// Takes a number with its signs from the front of the text; leaves the text as it is where there is none.
std::optional<double> take_number(std::string_view& text) {
    std::string_view left = text;
    double sign = 1;
    for (skip_spaces(left); left.starts_with('-') || left.starts_with('+'); skip_spaces(left)) {
        if (left.front() == '-') sign = -sign;
        left.remove_prefix(1);
    }
    if (left.empty() || (left.front() != '.' && (left.front() < '0' || left.front() > '9')))
        return std::nullopt; // "inf" is one to the library
    double number = 0;
    const auto [end, trouble] = std::from_chars(left.data(), left.data() + left.size(), number);
    if (trouble != std::errc{}) return std::nullopt;
    text = left.substr(static_cast<std::size_t>(end - left.data()));
    return sign * number;
}

// Takes one of these operators and the number behind it, or nothing of either.
struct Operation {
    char sign;
    double number;
};
std::optional<Operation> take_operation(std::string_view& text, std::string_view signs) {
    std::string_view left = text;
    skip_spaces(left);
    if (left.empty() || signs.find(left.front()) == std::string_view::npos) return std::nullopt;
    const char sign = left.front();
    left.remove_prefix(1);
    const std::optional<double> number = take_number(left);
    if (!number) return std::nullopt;
    text = left;
    return Operation{sign, *number};
}

double with_factors(double product, std::string_view& text) {
    while (const auto operation = take_operation(text, "*/"))
        product = operation->sign == '*' ? product * operation->number : product / operation->number;
    return product;
}

} // namespace

std::optional<Sum> sum_of(std::string_view text) {
    const std::optional<double> first = take_number(text);
    if (!first) return std::nullopt;
    Sum sum{with_factors(*first, text), {}};
    while (const auto operation = take_operation(text, "+-")) {
        const double term = with_factors(operation->number, text);
        sum.value += operation->sign == '+' ? term : -term;
    }
    sum.rest = text;
    return std::isfinite(sum.value) ? std::optional(sum) : std::nullopt;
}

} // namespace knead

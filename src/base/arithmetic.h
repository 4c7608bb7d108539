#pragma once
// Numbers that are typed as sums: "10/3", "2*0.25+1".

#include <optional>
#include <string_view>

namespace knead {

struct Sum {
    double value = 0;      // finite
    std::string_view rest; // of the text, behind it: a unit, or an operator that nothing follows yet
};
// The sum that a text begins with, of decimal numbers, + - * / and spaces, products first. Nothing where it
// begins with no number, or what it comes to is not finite.
std::optional<Sum> sum_of(std::string_view text);

} // namespace knead

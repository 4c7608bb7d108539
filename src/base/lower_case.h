#pragma once
// Names and extensions compared with letter case aside.

#include <string>

namespace knead {

// Text in lower case, as far as its letters are those of ASCII; the same in every locale.
inline std::string lower_case(std::string text) {
    for (char& letter : text)
        if (letter >= 'A' && letter <= 'Z') letter = static_cast<char>(letter - 'A' + 'a');
    return text;
}

} // namespace knead

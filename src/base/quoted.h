#pragma once
// A name in a sentence.

#include <string>

namespace knead {

inline std::string quoted(const std::string& name) {
    return "\"" + name + "\"";
}

} // namespace knead

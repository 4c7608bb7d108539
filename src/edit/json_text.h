#pragma once
// JSON on its way out, for other programs to read.

#include <nlohmann/json_fwd.hpp>

#include <string>

namespace knead {

// The value in lines, indented by two, without an end of line. It is ASCII: other characters are escaped,
// control characters too, so that whatever shows it has nothing to alter. Names come from files and arguments
// in any encoding, and JSON is UTF-8: bytes that are none become U+FFFD.
std::string json_text(const nlohmann::ordered_json& json);

// Text in any encoding as UTF-8, in which bytes that are none become U+FFFD: a name for a session file.
std::string utf8_of(const std::string& text);

} // namespace knead

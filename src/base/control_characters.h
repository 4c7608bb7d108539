#pragma once
// Text from files and arguments that is to be shown: it must neither break a message's line nor send commands
// to a terminal.

#include <string>
#include <string_view>

namespace knead {

// The text with one '?' for every control character (Unicode's category Cc: U+0000 … U+001F, U+007F and, as
// UTF-8 writes them, U+0080 … U+009F). `kept`: those of ASCII that stay, such as "\n".
std::string without_controls(std::string_view text, std::string_view kept = {});

} // namespace knead

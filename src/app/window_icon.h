#pragma once
// Private to this room: knead's icon, built in, for where windows are listed.

#include <cstdint>
#include <vector>

namespace knead {

// Bytes r g b a row by row from the top; square.
struct WindowIcon {
    int size = 0; // pixels, to each side
    std::vector<std::uint8_t> rgba;
};

WindowIcon window_icon();

} // namespace knead

#pragma once
// Private to this room: what the graphics card is told about each point's looks, in one word.

#include "render/point_renderer.h"

#include <vector>

namespace knead {

// The alpha of a tinted colour: 0 for a hidden point, else these bits. compose.frag reads them again.
inline constexpr std::uint32_t tint_visible = 1, tint_stripes = 2, tint_dots = 4, tint_selected = 8;

// Colours with the tint of the handles and the selection, and those bits as alpha. `colors`: n; `marks`: n
// or empty; `tinted`: n.
void tint_colors(std::span<const std::uint32_t> colors, std::span<const std::uint8_t> marks,
                 std::span<const HandleLook> looks, std::span<std::uint32_t> tinted);

} // namespace knead

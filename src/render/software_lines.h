#pragma once
// Private to this room: overlay lines as shaders/lines.frag draws them, by the processor.

#include "render/point_renderer.h"
#include "render/software_pixels.h"

#include <span>

namespace knead {

// How lines are drawn.
struct LineView {
    glm::mat4 to_clip{1.0f};
    float scale = 1;  // pixels of the screen in one of a line's width
    float nearer = 0; // how much nearer they are drawn than they are, as a difference in clip space over w
};

// A line on the screen: pixels from the upper left, depths 0 … 1.
struct FlatLine {
    glm::vec3 from{0.0f}, to{0.0f};
    float half_width = 0;
    std::uint32_t rgba = 0;
};
std::vector<FlatLine> flat_lines(std::span<const OverlayLine> lines, const LineView& view, Viewport viewport);

// Draws the rows first … end of all of them over a picture (bytes b, g, r, a), where the pixels are not
// nearer.
void draw_lines(std::span<const FlatLine> lines, int first, int end, const Pixels& pixels,
                std::uint32_t* picture);

} // namespace knead

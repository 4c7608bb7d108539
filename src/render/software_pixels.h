#pragma once
// Private to this room: pixels that the processor draws, and vectors of them.

#include "base/new_processors.h"
#include "base/workers.h"
#include "render/screen_pass.h"

#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace knead {

// Colours (as tinted) and depths (0 … 1), rows from the top as a window has them.
struct Pixels {
    int width = 0, height = 0;
    std::vector<std::uint32_t> colors;
    std::vector<float> depths;

    // Rows are padded, so that several pixels at once may be looked at beyond their ends.
    static constexpr std::size_t padding = 16;
    std::size_t row() const { return static_cast<std::size_t>(width) + padding; }
};

// Eight pixels of a row at a time, in the vectors of GCC and Clang.
constexpr int lanes = 8;
using Floats = float __attribute__((vector_size(4 * lanes)));
using Words = std::uint32_t __attribute__((vector_size(4 * lanes)));
using Mask = std::int32_t __attribute__((vector_size(4 * lanes)));

struct FlatLine; // software_lines.h

// The pass over the screen, on the processor. Keeps its last picture.
class SoftwareScreen {
public:
    void compose(const ScreenPass& pass, const Pixels& pixels, std::span<const FlatLine> lines,
                 Workers& workers);

    // Rows from the top, as long as those of the pixels; bytes b, g, r, a.
    const std::vector<std::uint32_t>& picture() const { return picture_; }

private:
    void draw_background(const ScreenPass& pass, const Pixels& pixels, Workers& workers);

    std::vector<std::uint32_t> picture_, background_;
    Viewport size_{0, 0}; // of the background, and its colours
    glm::vec3 top_{-1.0f}, bottom_{-1.0f};
};

} // namespace knead

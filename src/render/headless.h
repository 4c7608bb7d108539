#pragma once
// OpenGL with no display, and pictures drawn with it.

#include "render/point_renderer.h"

#include <memory>
#include <string>
#include <vector>

namespace knead {

// An OpenGL 4.1 core context of EGL that needs no display: a graphics card's where there is one, else Mesa's
// in software. Current on the calling thread from its making to its end. Throws Error (usage), which says
// what to install, where there is none.
class HeadlessContext {
public:
    HeadlessContext();
    ~HeadlessContext();
    HeadlessContext(const HeadlessContext&) = delete;
    HeadlessContext& operator=(const HeadlessContext&) = delete;

    std::string renderer() const; // who draws: "llvmpipe (LLVM 15.0.6, 256 bits)"

private:
    struct State;
    std::unique_ptr<State> state_;
};

// Bytes r g b row by row from the top, with no gaps.
struct Picture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> rgb; // 3 · width · height
};

// The largest width or height of a picture.
inline constexpr int largest_picture = 8192;

// Draws all points with a context current. `supersampling`² pixels are drawn for each of the picture and
// averaged (1 … 4; fewer where the picture would outgrow what the context can draw). What `look` tells in
// pixels are the picture's.
Picture draw_picture(PointRenderer& renderer, const Camera& camera, Viewport viewport, const PointLook& look,
                     int supersampling = 2);

} // namespace knead

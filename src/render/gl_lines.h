#pragma once
// Private to this room: overlay lines by OpenGL.

#include "render/layer.h"
#include "render/software_lines.h"

namespace knead {

class GlLines {
public:
    GlLines();

    // Over `finished`, hidden where `shown` is nearer.
    void draw(std::span<const OverlayLine> lines, const LineView& view, const Layer& shown,
              const Layer& finished);

private:
    GlProgram program_;
    GlBuffer buffer_;
    GlVertexArray array_;
};

} // namespace knead

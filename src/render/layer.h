#pragma once
// Private to this room: what is drawn into, as textures of the size of the screen.

#include "render/gl_objects.h"
#include "view/camera.h"

#include <optional>

namespace knead {

struct Layer {
    Viewport size{0, 0};
    std::optional<GlTexture> color, depth; // RGBA8; 32-bit floats, if asked for
    std::optional<GlFramebuffer> framebuffer;
};

// Binds the layer for drawing into, made anew if the screen changed its size.
void bind_layer(Layer& layer, Viewport size, bool with_depth);

} // namespace knead

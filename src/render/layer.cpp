#include "render/layer.h"

namespace knead {

namespace {

void make_texture(std::optional<GlTexture>& texture, Viewport size, GLint internal, GLenum format,
                  GLenum type) {
    texture.emplace();
    glBindTexture(GL_TEXTURE_2D, *texture);
    glTexImage2D(GL_TEXTURE_2D, 0, internal, size.width, size.height, 0, format, type, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

} // namespace

void bind_layer(Layer& layer, Viewport size, bool with_depth) {
    if (layer.size.width != size.width || layer.size.height != size.height) {
        layer.size = size;
        // In a window's order of bytes, so that copying into one is a copy and nothing else. Mesa keeps it so
        // where the format has no size; GL_RGBA8 has the bytes the other way round, whatever is handed over.
        make_texture(layer.color, size, GL_RGBA, GL_BGRA, GL_UNSIGNED_BYTE);
        layer.framebuffer.emplace();
        glBindFramebuffer(GL_FRAMEBUFFER, *layer.framebuffer);
        glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *layer.color, 0);
        if (with_depth) {
            make_texture(layer.depth, size, GL_DEPTH_COMPONENT32F, GL_DEPTH_COMPONENT, GL_FLOAT);
            glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, *layer.depth, 0);
        }
    }
    glBindFramebuffer(GL_FRAMEBUFFER, *layer.framebuffer);
}

} // namespace knead

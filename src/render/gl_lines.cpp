#include "render/gl_lines.h"

#include "render/shaders.h"

#include <cstddef>

namespace knead {

GlLines::GlLines() : program_(make_program(embedded::lines_vert, embedded::lines_frag)) {
    glBindVertexArray(array_);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    const auto attribute = [](GLuint location, GLint size, GLenum type, std::size_t at) {
        glVertexAttribPointer(location, size, type, type == GL_UNSIGNED_BYTE, sizeof(OverlayLine),
                              reinterpret_cast<const void*>(at));
        glVertexAttribDivisor(location, 1);
        glEnableVertexAttribArray(location);
    };
    attribute(0, 3, GL_FLOAT, offsetof(OverlayLine, from));
    attribute(1, 3, GL_FLOAT, offsetof(OverlayLine, to));
    attribute(2, 4, GL_UNSIGNED_BYTE, offsetof(OverlayLine, rgba));
    attribute(3, 1, GL_FLOAT, offsetof(OverlayLine, width));
    glBindVertexArray(0);
}

void GlLines::draw(std::span<const OverlayLine> lines, const LineView& view, const Layer& shown,
                   const Layer& finished) {
    const GlFramebuffer target; // the colours of one with the depths of the other
    glBindFramebuffer(GL_FRAMEBUFFER, target);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, *finished.color, 0);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, *shown.depth, 0);
    glViewport(0, 0, finished.size.width, finished.size.height);
    glUseProgram(program_);
    const auto at = [&](const char* name) { return glGetUniformLocation(program_, name); };
    glUniformMatrix4fv(at("to_clip"), 1, GL_FALSE, &view.to_clip[0][0]);
    glUniform2f(at("screen"), static_cast<float>(finished.size.width),
                static_cast<float>(finished.size.height));
    glUniform1f(at("scale"), view.scale);
    glUniform1f(at("nearer"), view.nearer);
    glBindBuffer(GL_ARRAY_BUFFER, buffer_);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lines.size_bytes()), lines.data(), GL_DYNAMIC_DRAW);
    glBindVertexArray(array_);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LEQUAL);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(lines.size()));
    glDisable(GL_BLEND);
    glDepthMask(GL_TRUE);
    glDisable(GL_DEPTH_TEST);
}

} // namespace knead

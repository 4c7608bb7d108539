#include "render/screen_pass.h"
#include "render/shaders.h"

#include <array>
#include <string>

namespace knead {

namespace {

void set_uniforms(GLuint compose, const ScreenPass& pass) {
    const auto at = [compose](const char* name) { return glGetUniformLocation(compose, name); };
    glUniform1i(at("colors"), 0);
    glUniform1i(at("depths"), 1);
    set_vector(at("depth_scale"), pass.depth_scale);
    glUniform2i(at("taps"), pass.near, pass.far);
    glUniform1f(at("strength"), pass.strength);
    glUniform1f(at("grain"), pass.grain);
    set_vector(at("key"), pass.key);
    glUniform1f(at("pattern"), pass.pattern);
    glUniform2i(at("last"), pass.viewport.width - 1, pass.viewport.height - 1);
}

} // namespace

struct GlScreen::State {
    std::array<std::array<std::optional<GlProgram>, 2>, 2> programs; // [with relief][with patterns]
    GlProgram background =
        make_program(embedded::screen_vert, embedded::compose_frag, "#define BACKGROUND\n");
    GlVertexArray nothing;

    // What is not needed is not compiled in.
    GLuint compose_program(bool relief, bool patterns) {
        std::optional<GlProgram>& program = programs[relief ? 1 : 0][patterns ? 1 : 0];
        if (!program) {
            const std::string defines =
                std::string(relief ? "#define RELIEF\n" : "") + (patterns ? "#define PATTERNS\n" : "");
            program = make_program(embedded::screen_vert, embedded::compose_frag, defines.c_str());
        }
        return *program;
    }
};

GlScreen::GlScreen() : state_(std::make_unique<State>()) {}
GlScreen::~GlScreen() = default;

void GlScreen::draw(const ScreenPass& pass, const Layer& shown, Layer& finished) {
    bind_layer(finished, pass.viewport, false);
    glViewport(0, 0, pass.viewport.width, pass.viewport.height);
    glBindVertexArray(state_->nothing);
    const auto use = [&](GLuint program) {
        glUseProgram(program);
        set_vector(glGetUniformLocation(program, "top"), pass.top);
        set_vector(glGetUniformLocation(program, "bottom"), pass.bottom);
        glUniform1f(glGetUniformLocation(program, "height"), static_cast<float>(pass.viewport.height));
    };
    use(state_->background);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    if (pass.from.x >= pass.to.x || pass.from.y >= pass.to.y) return;
    const GLuint compose = state_->compose_program(pass.relief, pass.patterns);
    use(compose);
    set_uniforms(compose, pass);
    glActiveTexture(GL_TEXTURE1);
    glBindTexture(GL_TEXTURE_2D, *shown.depth);
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, *shown.color);
    glEnable(GL_SCISSOR_TEST);
    glScissor(pass.from.x, pass.from.y, pass.to.x - pass.from.x, pass.to.y - pass.from.y);
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_SCISSOR_TEST);
}

} // namespace knead

#pragma once
// Private to this room: OpenGL objects that release themselves.

#include "view/camera.h"

#include <epoxy/gl.h>

#include <utility>

namespace knead {

// `make` and `release` are functions of the room, since OpenGL's own are pointers filled at run time.
template<GLuint (*make)(), void (*release)(GLuint)>
class GlObject {
public:
    GlObject() : name_(make()) {}
    ~GlObject() {
        if (name_ != 0) release(name_);
    }
    GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)) {}
    GlObject& operator=(GlObject&& other) noexcept {
        std::swap(name_, other.name_);
        return *this;
    }
    operator GLuint() const { return name_; }

private:
    GLuint name_;
};

namespace gl {

inline GLuint make_buffer() {
    GLuint name = 0;
    glGenBuffers(1, &name);
    return name;
}
inline void release_buffer(GLuint name) {
    glDeleteBuffers(1, &name);
}

inline GLuint make_texture() {
    GLuint name = 0;
    glGenTextures(1, &name);
    return name;
}
inline void release_texture(GLuint name) {
    glDeleteTextures(1, &name);
}

inline GLuint make_framebuffer() {
    GLuint name = 0;
    glGenFramebuffers(1, &name);
    return name;
}
inline void release_framebuffer(GLuint name) {
    glDeleteFramebuffers(1, &name);
}

inline GLuint make_vertex_array() {
    GLuint name = 0;
    glGenVertexArrays(1, &name);
    return name;
}
inline void release_vertex_array(GLuint name) {
    glDeleteVertexArrays(1, &name);
}

inline GLuint make_program() {
    return glCreateProgram();
}
inline void release_program(GLuint name) {
    glDeleteProgram(name);
}

} // namespace gl

using GlBuffer = GlObject<gl::make_buffer, gl::release_buffer>;
using GlTexture = GlObject<gl::make_texture, gl::release_texture>;
using GlFramebuffer = GlObject<gl::make_framebuffer, gl::release_framebuffer>;
using GlVertexArray = GlObject<gl::make_vertex_array, gl::release_vertex_array>;
using GlProgram = GlObject<gl::make_program, gl::release_program>;

// A program of two shaders' texts; `defines` ("#define ROUND\n") go behind their #version lines. Breaks off
// with the compiler's words if they do not compile, since they are part of knead.
GlProgram make_program(const char* vertex, const char* fragment, const char* defines = "");

// A uniform of the program in use.
inline void set_vector(GLint location, const glm::vec3& v) {
    glUniform3f(location, v.x, v.y, v.z);
}

} // namespace knead

#include "render/gl_objects.h"

#include <stdexcept>
#include <string>

namespace knead {

namespace {

// The shader, attached to the program. The text begins with its #version line.
void attach(GLuint program, GLenum type, const std::string& text, const std::string& defines) {
    const std::size_t end_of_version = text.find('\n') + 1;
    const std::string whole = text.substr(0, end_of_version) + defines + text.substr(end_of_version);
    const char* source = whole.c_str();
    const GLuint shader = glCreateShader(type);
    glShaderSource(shader, 1, &source, nullptr);
    glCompileShader(shader);
    glAttachShader(program, shader);
    GLint good = 0;
    glGetShaderiv(shader, GL_COMPILE_STATUS, &good);
    char words[4096] = "";
    if (!good) glGetShaderInfoLog(shader, sizeof words, nullptr, words);
    glDeleteShader(shader); // goes with the program
    if (!good) throw std::logic_error(std::string("a shader does not compile: ") + words);
}

} // namespace

GlProgram make_program(const char* vertex, const char* fragment, const char* defines) {
    GlProgram program;
    attach(program, GL_VERTEX_SHADER, vertex, defines);
    attach(program, GL_FRAGMENT_SHADER, fragment, defines);
    glLinkProgram(program);
    GLint good = 0;
    glGetProgramiv(program, GL_LINK_STATUS, &good);
    if (!good) {
        char words[4096] = "";
        glGetProgramInfoLog(program, sizeof words, nullptr, words);
        throw std::logic_error(std::string("a shader program does not link: ") + words);
    }
    return program;
}

} // namespace knead

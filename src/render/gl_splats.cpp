#include "render/gl_lines.h"
#include "render/shaders.h"
#include "render/splats.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

namespace knead {

namespace {

struct PointProgram {
    GlProgram program;
    GLint to_clip, size, growth, extremes, right, up, forward, key, pixel_size, half_field;
};

PointProgram make_point_program(bool shaded, bool discs) {
    std::string defines;
    if (shaded) defines += "#define SHADED\n";
    if (discs) defines += "#define DISCS\n";
    const auto define = [&defines](const char* name, float value) {
        defines += std::string("#define ") + name + ' ' + std::to_string(value) + '\n';
    };
    define("BULGE_OVER_DIAMETER", bulge_over_diameter);
    define("TILT_OVER_BULGE", tilt_over_bulge);
    define("STEEPEST", steepest);
    GlProgram program = make_program(embedded::points_vert, embedded::points_frag, defines.c_str());
    const auto find = [&](const char* name) { return glGetUniformLocation(program, name); };
    const GLint to_clip = find("to_clip"), size = find("size"), growth = find("growth"),
                extremes = find("extremes"), right = find("right"), up = find("up"),
                forward = find("forward"), key = find("key"), pixel_size = find("pixel_size"),
                half_field = find("half_field");
    return {std::move(program), to_clip,   size, growth, extremes, right, up, forward, key,
            pixel_size,         half_field};
}

template<typename Item>
void upload(GLuint buffer, std::span<const Item> items) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(items.size_bytes()), items.data());
}

// Three floats a point, of these chunks: those that follow each other at once.
void upload(GLuint buffer, std::span<const float> vectors, std::span<const Index> chunks) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    for (std::size_t at = 0; at < chunks.size();) {
        std::size_t end = at + 1;
        while (end < chunks.size() && chunks[end] == chunks[end - 1] + 1) ++end;
        const std::size_t first = 3 * points_in_chunk * chunks[at];
        const std::size_t count =
            std::min(3 * points_in_chunk * (std::size_t{chunks[end - 1]} + 1), vectors.size()) - first;
        const std::span<const float> part = vectors.subspan(first, count);
        glBufferSubData(GL_ARRAY_BUFFER, static_cast<GLintptr>(first * sizeof(float)),
                        static_cast<GLsizeiptr>(part.size_bytes()), part.data());
        at = end;
    }
}

void allocate(GLuint buffer, std::size_t bytes) {
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(bytes), nullptr, GL_DYNAMIC_DRAW);
}

void clear_bound_layer() {
    const float nothing[4] = {0, 0, 0, 0}, far = 1;
    glClearBufferfv(GL_COLOR, 0, nothing);
    glClearBufferfv(GL_DEPTH, 0, &far);
}

class GlSplats final : public Splats {
public:
    void set_points(std::size_t n) override {
        n_ = n;
        has_normal_buffer_ = has_widths_ = false;
        allocate(positions_, 12 * n);
        allocate(colors_, 4 * n);
    }
    void set_positions(std::span<const float> positions, std::span<const Index> chunks) override {
        upload(positions_, positions, chunks);
    }
    void set_normals(std::span<const float> normals, std::span<const Index> chunks) override {
        if (!has_normal_buffer_) allocate(normals_, 12 * n_);
        has_normal_buffer_ = true;
        upload(normals_, normals, chunks);
    }
    PointRenderer::DrawnBuffers buffers() override {
        return {positions_, has_normal_buffer_ ? GLuint{normals_} : 0};
    }
    void set_widths(std::span<const std::uint8_t> widths) override {
        has_widths_ = !widths.empty();
        if (!has_widths_) return;
        allocate(widths_, n_);
        upload(widths_, widths);
    }
    void set_tinted(std::span<const std::uint32_t> tinted) override { upload(colors_, tinted); }

    std::size_t draw(std::span<const PointRange> ranges, std::size_t subset, std::size_t stride,
                     const SplatView& view, Layer& layer, bool clear) override {
        bind_layer(layer, view.viewport, true);
        glViewport(0, 0, view.viewport.width, view.viewport.height);
        if (clear) clear_bound_layer();
        const std::size_t drawn = list_ranges(ranges, subset, stride);
        if (drawn == 0) return 0;
        use_program(view);
        bind_attributes(subset, stride, view.shaded);
        glEnable(GL_PROGRAM_POINT_SIZE);
        glEnable(GL_DEPTH_TEST);
        glDepthFunc(GL_LESS);
        glDepthMask(GL_TRUE);
        glMultiDrawArrays(GL_POINTS, firsts_.data(), counts_.data(), static_cast<GLsizei>(firsts_.size()));
        glDisable(GL_DEPTH_TEST);
        return drawn;
    }

    void finish(const ScreenPass& pass, const Overlay& overlay, Layer& shown, bool /*is_new*/,
                Layer& finished) override {
        screen_.draw(pass, shown, finished);
        if (!overlay.lines.empty()) lines_.draw(overlay.lines, overlay.view, shown, finished);
    }

private:
    std::size_t list_ranges(std::span<const PointRange> ranges, std::size_t subset, std::size_t stride) {
        firsts_.clear();
        counts_.clear();
        std::size_t drawn = 0;
        for (const PointRange& range : ranges) {
            const Elements elements = elements_of(range, subset, stride);
            if (elements.first == elements.end) continue;
            firsts_.push_back(static_cast<GLint>(elements.first));
            counts_.push_back(static_cast<GLsizei>(elements.end - elements.first));
            drawn += elements.end - elements.first;
        }
        return drawn;
    }

    void use_program(const SplatView& view) {
        const bool discs = view.widest > widest_square;
        std::optional<PointProgram>& with = programs_[view.shaded ? 1 : 0][discs ? 1 : 0];
        if (!with) with = make_point_program(view.shaded, discs);
        glUseProgram(with->program);
        glUniformMatrix4fv(with->to_clip, 1, GL_FALSE, &view.to_clip[0][0]);
        glUniform2f(with->size, view.fixed, view.by_distance);
        glUniform2f(with->growth, view.grown_to, view.grown);
        glUniform2f(with->extremes, view.smallest, view.largest);
        glUniform1f(with->pixel_size, view.pixel_size);
        glUniform2f(with->half_field, view.half_field.x, view.half_field.y);
        set_vector(with->right, view.right);
        set_vector(with->up, view.up);
        set_vector(with->forward, view.forward);
        set_vector(with->key, view.key);
    }

    // Every stride-th point, from `subset` on, without an index.
    void bind_attributes(std::size_t subset, std::size_t stride, bool shaded) {
        glBindVertexArray(array_);
        const auto attribute = [&](GLuint location, GLuint buffer, GLint size, GLenum type,
                                   std::size_t bytes) {
            glBindBuffer(GL_ARRAY_BUFFER, buffer);
            glVertexAttribPointer(location, size, type, type == GL_UNSIGNED_BYTE,
                                  static_cast<GLsizei>(bytes * stride),
                                  reinterpret_cast<const void*>(bytes * subset));
            glEnableVertexAttribArray(location);
        };
        if (has_widths_) {
            attribute(3, widths_, 1, GL_UNSIGNED_BYTE, 1);
        } else {
            glDisableVertexAttribArray(3);
            glVertexAttrib1f(3, 0);
        }
        attribute(0, positions_, 3, GL_FLOAT, 12);
        attribute(1, colors_, 4, GL_UNSIGNED_BYTE, 4);
        if (shaded)
            attribute(2, normals_, 3, GL_FLOAT, 12);
        else
            glDisableVertexAttribArray(2);
    }

    std::size_t n_ = 0;
    bool has_normal_buffer_ = false, has_widths_ = false;
    GlBuffer positions_, normals_, colors_, widths_;
    GlVertexArray array_;
    std::array<std::array<std::optional<PointProgram>, 2>, 2> programs_; // [shaded][discs]
    GlScreen screen_;
    GlLines lines_;
    std::vector<GLint> firsts_;
    std::vector<GLsizei> counts_;
};

} // namespace

std::unique_ptr<Splats> make_gl_splats() {
    return std::make_unique<GlSplats>();
}

} // namespace knead

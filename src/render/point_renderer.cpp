#include "render/point_renderer.h"

#include "base/error.h"
#include "base/require.h"
#include "render/chunks.h"
#include "render/progressive_picture.h"
#include "render/splats.h"
#include "render/tinting.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace knead {

namespace {

// Splats where points lie farther apart than usual are so many times as wide at most.
constexpr double most_wider = 4;

// Whether OpenGL runs on the processor.
bool opengl_is_software() {
    const std::string name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const char* known : {"llvmpipe", "softpipe", "SwiftShader", "Software"})
        if (name.find(known) != std::string::npos) return true;
    return false;
}

} // namespace

struct PointRenderer::State {
    Workers workers;
    std::unique_ptr<Splats> splats;
    DrawnCloud cloud;
    DrawnOverlay overlay;
    ProgressivePicture picture;
    bool has_positions = false;
    std::vector<Index> changed_chunks; // scratch

    // --- What colours the points ---
    std::vector<std::uint32_t> colors, tinted;
    std::vector<std::uint8_t> marks;
    std::vector<HandleLook> looks;
    bool tints_are_stale = false;

    void tints_changed();
    void refresh_tints();
    std::span<const Index> chunks_to_take(bool all, std::span<const PointRange> changed);
};

void PointRenderer::State::tints_changed() {
    tints_are_stale = true;
    ++cloud.version;
}

void PointRenderer::State::refresh_tints() {
    if (!tints_are_stale) return;
    tints_are_stale = false;
    tinted.resize(cloud.n);
    tint_colors(colors, marks, looks, tinted);
    splats->set_tinted(tinted);
}

std::span<const Index> PointRenderer::State::chunks_to_take(bool all, std::span<const PointRange> changed) {
    const PointRange whole{0, cloud.n};
    chunks_with(all ? std::span(&whole, 1) : changed, changed_chunks);
    return changed_chunks;
}

PointRenderer::PointRenderer(Drawing drawing) {
    if (epoxy_gl_version() < 41)
        throw Error(Trouble::usage, "",
                    std::string("knead draws with OpenGL 4.1, and here is only ") +
                        reinterpret_cast<const char*>(glGetString(GL_VERSION)) + " (" +
                        reinterpret_cast<const char*>(glGetString(GL_RENDERER)) + ")");
    state_ = std::make_unique<State>();
    State& s = *state_;
    const bool in_software =
        drawing == Drawing::chosen ? opengl_is_software() : drawing == Drawing::by_processor;
    s.splats = in_software ? make_software_splats(s.workers) : make_gl_splats();
}

PointRenderer::~PointRenderer() = default;

bool PointRenderer::is_software() const {
    return state_->splats->by_processor();
}

void PointRenderer::set_points(std::size_t n, double spacing) {
    State& s = *state_;
    const std::uint64_t version = s.cloud.version + 1;
    s.cloud = {};
    s.cloud.n = n;
    s.cloud.spacing = spacing;
    s.cloud.chunks.assign(chunks_of(n), Chunk{});
    s.cloud.version = version;
    s.has_positions = false;
    s.colors.assign(n, 0xffb8b8b8);
    s.marks.clear();
    s.tints_are_stale = true;
    s.splats->set_points(n);
}

std::size_t PointRenderer::points() const {
    return state_->cloud.n;
}

void PointRenderer::set_positions(std::span<const float> positions) {
    state_->has_positions = false;
    set_positions(positions, {});
}

void PointRenderer::set_positions(std::span<const float> positions, std::span<const PointRange> changed) {
    State& s = *state_;
    require(positions.size() == 3 * s.cloud.n, "three coordinates a point");
    const std::span<const Index> chunks = s.chunks_to_take(!s.has_positions, changed);
    s.splats->set_positions(positions, chunks);
    bound_chunks(positions, chunks, s.cloud.chunks, s.workers);
    s.has_positions = true;
    ++s.cloud.version;
}

void PointRenderer::set_normals(std::span<const float> normals) {
    state_->cloud.has_normals = false;
    set_normals(normals, {});
}

void PointRenderer::set_normals(std::span<const float> normals, std::span<const PointRange> changed) {
    State& s = *state_;
    require(normals.empty() || normals.size() == 3 * s.cloud.n, "three numbers a normal");
    if (!normals.empty()) s.splats->set_normals(normals, s.chunks_to_take(!s.cloud.has_normals, changed));
    s.cloud.has_normals = !normals.empty();
    ++s.cloud.version;
}

PointRenderer::DrawnBuffers PointRenderer::buffers_to_write() {
    State& s = *state_;
    const DrawnBuffers buffers = s.splats->buffers();
    if (!s.has_positions || buffers.positions == 0) return {};
    glFinish();
    return {buffers.positions, s.cloud.has_normals ? buffers.normals : 0};
}

void PointRenderer::note_written(std::span<const std::array<float, 6>> boxes, std::size_t points_in_box) {
    State& s = *state_;
    require(boxes.size() == (s.cloud.n + points_in_box - 1) / points_in_box, "a box for all points");
    join_boxes(boxes, points_in_box, s.cloud.chunks);
    ++s.cloud.version;
}

void PointRenderer::set_colors(std::span<const std::uint32_t> rgba) {
    State& s = *state_;
    require(rgba.size() == s.cloud.n, "a colour a point");
    s.colors.assign(rgba.begin(), rgba.end());
    s.tints_changed();
}

void PointRenderer::set_spacings(std::span<const float> spacings) {
    State& s = *state_;
    require(spacings.empty() || spacings.size() == s.cloud.n, "a spacing a point");
    std::vector<std::uint8_t> widths(spacings.size());
    s.cloud.widest_width = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const double wider = std::clamp(static_cast<double>(spacings[i]) / s.cloud.spacing, 1.0, most_wider);
        widths[i] = static_cast<std::uint8_t>(std::lround(widths_in_double * std::log2(wider)));
        s.cloud.widest_width = std::max(s.cloud.widest_width, widths[i]);
    }
    s.splats->set_widths(widths);
    ++s.cloud.version;
}

void PointRenderer::set_marks(std::span<const std::uint8_t> marks) {
    State& s = *state_;
    require(marks.empty() || marks.size() == s.cloud.n, "a mark a point");
    s.marks.assign(marks.begin(), marks.end());
    s.cloud.has_marks = !marks.empty();
    s.tints_changed();
}

void PointRenderer::set_handle_looks(std::span<const HandleLook> looks) {
    state_->looks.assign(looks.begin(), looks.end());
    state_->tints_changed();
}

void PointRenderer::set_overlay(std::span<const OverlayLine> lines) {
    State& s = *state_;
    s.overlay.lines.assign(lines.begin(), lines.end());
    Box3 box;
    for (const OverlayLine& line : lines) {
        const glm::dvec3 from(line.from), to(line.to);
        if (&line == lines.data()) box = {from, from};
        box.lowest = glm::min(box.lowest, glm::min(from, to));
        box.highest = glm::max(box.highest, glm::max(from, to));
    }
    // The planes of the projection enclose the lines as well, so an overlay of another size is a new scene;
    // where there is none any more, they may stay as they are.
    const bool is_other =
        !s.overlay.box || s.overlay.box->lowest != box.lowest || s.overlay.box->highest != box.highest;
    if (!lines.empty() && is_other) ++s.cloud.version;
    s.overlay.box = lines.empty() ? std::nullopt : std::optional(box);
    if (s.splats->by_processor()) ++s.cloud.version;
    ++s.overlay.version;
}

DrawResult PointRenderer::draw(const Camera& camera, Viewport viewport, const PointLook& look,
                               std::size_t budget, const PictureTarget& target) {
    State& s = *state_;
    for (const GLenum what : {GL_SCISSOR_TEST, GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST})
        glDisable(what);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    s.refresh_tints();
    const DrawResult result =
        s.picture.draw({camera, viewport, look, s.cloud.version}, budget, s.cloud, s.overlay, *s.splats);
    const Viewport size = target.size.width > 0 ? target.size : viewport;
    const bool same_size = size.width == viewport.width && size.height == viewport.height;
    const int low = s.splats->by_processor() ? viewport.height : 0;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, *s.picture.finished().framebuffer);
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, target.framebuffer);
    glBlitFramebuffer(0, low, viewport.width, viewport.height - low, target.left, target.bottom,
                      target.left + size.width, target.bottom + size.height, GL_COLOR_BUFFER_BIT,
                      same_size ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, target.framebuffer);
    glBindVertexArray(0);
    glUseProgram(0);
    return result;
}

} // namespace knead

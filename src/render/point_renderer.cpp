#include "render/point_renderer.h"

#include "base/error.h"
#include "base/require.h"
#include "base/stopwatch.h"
#include "render/chunks.h"
#include "render/layer.h"
#include "render/splats.h"
#include "render/tinting.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

namespace knead {

namespace {

// Of a splat's diameter over the spacing of the points: what closes most scans' surfaces.
constexpr double closing_factor = 2.0;
// A splat of one in k is drawn √k larger: so many times at most, or so many pixels wide. (Where the points
// lie far closer together than pixels, a surface of a few of them would be full of holes.)
constexpr double largest_enlargement = 4, widest_enlarged = 5;
constexpr double most_wider = 4;    // where points lie farther apart than usual
constexpr float largest_splat = 96; // pixels
constexpr float widest_flat = 8;    // pixels; wider splats are curved, which costs

// Where the light comes from, in the camera's axes: from above the left shoulder.
constexpr glm::vec3 key_light(-0.35f, 0.55f, 0.9f);

// Whether OpenGL runs on the processor.
bool opengl_is_software() {
    const std::string name = reinterpret_cast<const char*>(glGetString(GL_RENDERER));
    for (const char* known : {"llvmpipe", "softpipe", "SwiftShader", "Software"})
        if (name.find(known) != std::string::npos) return true;
    return false;
}

} // namespace

// What a picture shows; a picture of the same scene is not drawn again.
struct Shown {
    Camera camera;
    Viewport viewport;
    PointLook look;
    std::uint64_t points_version = 0;
};

struct PointRenderer::State {
    // --- The points ---
    std::size_t n = 0;
    double spacing = 0;
    bool has_positions = false, has_normals = false;
    std::vector<std::uint32_t> colors, tinted;
    std::vector<std::uint8_t> marks;
    std::vector<HandleLook> looks;
    bool tints_are_stale = false;
    std::vector<Chunk> chunks;
    std::vector<Index> changed_chunks;
    std::uint8_t widest_width = 0; // of the splats, see Splats::set_widths()
    Workers workers;
    std::unique_ptr<Splats> splats;
    std::uint64_t points_version = 0;

    // --- The overlay ---
    std::vector<OverlayLine> lines;
    std::optional<Box3> lines_box; // nothing: no lines
    std::uint64_t overlay_version = 0;

    // --- The picture in the making ---
    Layer shown, growing; // what is on the screen, and the whole cloud as far as it has come
    Layer finished;       // `shown` after the pass over the screen, with the overlay
    Shown scene;
    bool is_drawn = false; // whether `shown` is of `scene`
    glm::dmat4 projection{1.0}, to_clip{1.0};
    InView in_view;
    double widest_splat = 0, usual_splat = 0; // pixels; the widest in view, and one at the pivot
    std::size_t one_in = 1;                   // the first subset is one in so many
    std::size_t next_subset = 0;              // of one_in; all are drawn: complete
    std::uint64_t finished_overlay = 0;

    void refresh_tints();
    std::span<const Index> chunks_to_take(bool all, std::span<const PointRange> changed);
    bool matches(const Shown& other) const;
    void project_onto(Box3 box);
    void begin(const Shown& next, std::size_t budget);
    SplatView view_of(double enlargement) const;
    double usual_width(const SplatView& view) const; // of a splat at the pivot, pixels
    double enlargement() const;                      // of the splats of the first subset
    std::size_t draw_subset(std::size_t subset, double enlargement, Layer& layer, bool clear);
    ScreenPass screen_pass() const;
    Overlay overlay() const;
    void finish(bool is_new);
    DrawResult draw(const Shown& next, std::size_t budget);
};

void PointRenderer::State::refresh_tints() {
    if (!tints_are_stale) return;
    tints_are_stale = false;
    tinted.resize(n);
    tint_colors(colors, marks, looks, tinted);
    splats->set_tinted(tinted);
}

std::span<const Index> PointRenderer::State::chunks_to_take(bool all, std::span<const PointRange> changed) {
    const PointRange whole{0, n};
    chunks_with(all ? std::span(&whole, 1) : changed, changed_chunks);
    return changed_chunks;
}

bool PointRenderer::State::matches(const Shown& other) const {
    return is_drawn && scene.camera == other.camera && scene.viewport.width == other.viewport.width &&
           scene.viewport.height == other.viewport.height && scene.look == other.look &&
           scene.points_version == other.points_version;
}

// Takes the projection whose near and far planes enclose the box and the overlay.
void PointRenderer::State::project_onto(Box3 box) {
    if (lines_box) {
        box.lowest = glm::min(box.lowest, lines_box->lowest);
        box.highest = glm::max(box.highest, lines_box->highest);
    }
    // Room for the splats, and for boxes that are flat.
    const glm::dvec3 room(2 * spacing + 1e-3 * glm::length(box.highest - box.lowest));
    projection = projection_matrix(scene.camera, scene.viewport, {box.lowest - room, box.highest + room});
    to_clip = projection * view_matrix(scene.camera);
}

// Chooses what is drawn of a new scene.
void PointRenderer::State::begin(const Shown& next, std::size_t budget) {
    scene = next;
    widest_splat = 0;
    refresh_tints();
    // First what is in view; then near and far planes that enclose no more than that, so that depths are
    // fine.
    project_onto(box_around(chunks));
    const float margin = largest_splat * scene.look.pixel_scale /
                         static_cast<float>(std::min(scene.viewport.width, scene.viewport.height));
    in_view = chunks_in_view(chunks, n, to_clip, margin);
    if (in_view.points > 0) project_onto(in_view.box);
    const std::size_t most = std::max<std::size_t>(budget, 1);
    one_in = std::max<std::size_t>(1, (in_view.points + most - 1) / most);
}

SplatView PointRenderer::State::view_of(double enlargement) const {
    const PointLook& look = scene.look;
    const double pixels_a_unit = 0.5 * projection[1][1] * scene.viewport.height; // at w = 1
    const double fixed = look.size_by_distance ? 0 : look.pixels * look.pixel_scale * enlargement;
    const double by_distance =
        look.size_by_distance ? spacing * closing_factor * look.scale * enlargement * pixels_a_unit : 0;
    SplatView view;
    view.viewport = scene.viewport;
    view.to_clip = glm::mat4(to_clip);
    view.fixed = static_cast<float>(fixed);
    view.by_distance = static_cast<float>(by_distance);
    view.grown_to = static_cast<float>(widest_enlarged) * look.pixel_scale;
    view.grown = static_cast<float>(std::min(1.0, largest_enlargement / enlargement));
    view.smallest = look.pixel_scale;
    view.largest = largest_splat * look.pixel_scale;
    view.curved = widest_flat * look.pixel_scale;
    const double widest = fixed + by_distance * std::exp2(widest_width / widths_in_double) / in_view.nearest;
    view.widest = diameter_of(view, static_cast<float>(widest));
    view.pixel_size = static_cast<float>(1 / pixels_a_unit);
    const glm::mat3 axes = glm::mat3_cast(glm::quat(scene.camera.orientation));
    view.forward = -axes[2];
    view.key = glm::normalize(axes * key_light);
    view.shaded = look.shading && has_normals;
    return view;
}

double PointRenderer::State::usual_width(const SplatView& view) const {
    const double w = scene.camera.orthographic ? 1 : scene.camera.distance;
    return view.fixed + view.by_distance / w;
}

double PointRenderer::State::enlargement() const {
    const double plain = usual_width(view_of(1));
    const double most = std::max(largest_enlargement, widest_enlarged * scene.look.pixel_scale / plain);
    return std::min(std::sqrt(static_cast<double>(one_in)), most);
}

// Draws subset number `subset` of those in view; returns how many points it has.
std::size_t PointRenderer::State::draw_subset(std::size_t subset, double enlargement, Layer& layer,
                                              bool clear) {
    const SplatView view = view_of(enlargement);
    widest_splat = std::max<double>(widest_splat, view.widest);
    usual_splat = std::clamp<double>(usual_width(view), view.smallest, view.largest);
    return splats->draw(in_view.ranges, subset, one_in, view, layer, clear);
}

ScreenPass PointRenderer::State::screen_pass() const {
    const PointLook& look = scene.look;
    ScreenPass pass;
    pass.viewport = scene.viewport;
    pass.top = look.background_top;
    pass.bottom = look.background_bottom;
    if (in_view.points > 0) {
        const glm::dvec2 screen(scene.viewport.width, scene.viewport.height), reach(widest_splat);
        pass.from = glm::floor((0.5 + 0.5 * in_view.lowest) * screen - reach);
        pass.to = glm::ceil((0.5 + 0.5 * in_view.highest) * screen + reach);
    }
    const double pixel = 2 / (projection[1][1] * scene.viewport.height); // its length, at w = 1
    const double a = projection[2][2], b = projection[3][2];
    pass.depth_scale = scene.camera.orthographic ? glm::dvec3(2 / (std::abs(a) * pixel), 1, 0)
                                                 : glm::dvec3(2 / (std::abs(b) * pixel), (a - 1) / b,
                                                              2 / b); // 1 / z = (2 depth - 1 + a) / b
    pass.near = std::max(1, static_cast<int>(std::lround(look.pixel_scale)));
    pass.far = 3 * pass.near;
    pass.strength = look.eye_dome ? 1.0f : 0.0f;
    pass.grain = static_cast<float>(0.5 * usual_splat);
    pass.key = glm::normalize(key_light);
    pass.pattern = look.pixel_scale;
    pass.relief = look.shading && !has_normals;
    pass.patterns = !marks.empty();
    return pass;
}

Overlay PointRenderer::State::overlay() const {
    // Three spacings at the pivot's distance, as a difference of depths.
    const double z = scene.camera.distance;
    const double slope =
        scene.camera.orthographic ? std::abs(projection[2][2]) : std::abs(projection[3][2]) / (z * z);
    return {lines, {glm::mat4(to_clip), scene.look.pixel_scale, static_cast<float>(3 * spacing * slope)}};
}

// The pass over the screen, and the overlay: from `shown` to `finished`.
void PointRenderer::State::finish(bool is_new) {
    splats->finish(screen_pass(), overlay(), shown, is_new, finished);
    finished_overlay = overlay_version;
}

DrawResult PointRenderer::State::draw(const Shown& next, std::size_t budget) {
    DrawResult result;
    bool is_new = true, changed = true;
    const Stopwatch clock;
    if (!matches(next)) {
        begin(next, budget);
        result.drawn = draw_subset(0, enlargement(), shown, true);
        next_subset = one_in == 1 ? 1 : 0;
        is_drawn = true;
    } else if (next_subset < one_in) {
        result.drawn = draw_subset(next_subset, 1, growing, next_subset == 0);
        ++next_subset;
        is_new = next_subset == one_in;
        if (is_new) std::swap(shown, growing);
        changed = is_new || finished_overlay != overlay_version;
    } else {
        is_new = false;
        changed = finished_overlay != overlay_version;
    }
    result.seconds = clock.seconds();
    if (changed) finish(is_new);
    result.complete = next_subset == one_in;
    result.in_view = in_view.points;
    result.one_in = result.complete ? 1 : one_in;
    return result;
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
    s.n = n;
    s.spacing = spacing;
    s.has_normals = false;
    s.colors.assign(n, 0xffb8b8b8);
    s.marks.clear();
    s.tints_are_stale = true;
    s.widest_width = 0;
    s.splats->set_points(n);
    s.has_positions = false;
    s.chunks.assign(chunks_of(n), Chunk{});
    ++s.points_version;
}

std::size_t PointRenderer::points() const {
    return state_->n;
}

void PointRenderer::set_positions(std::span<const float> positions) {
    state_->has_positions = false;
    set_positions(positions, {});
}

void PointRenderer::set_positions(std::span<const float> positions, std::span<const PointRange> changed) {
    State& s = *state_;
    require(positions.size() == 3 * s.n, "three coordinates a point");
    const std::span<const Index> chunks = s.chunks_to_take(!s.has_positions, changed);
    s.splats->set_positions(positions, chunks);
    bound_chunks(positions, chunks, s.chunks, s.workers);
    s.has_positions = true;
    ++s.points_version;
}

void PointRenderer::set_normals(std::span<const float> normals) {
    state_->has_normals = false;
    set_normals(normals, {});
}

void PointRenderer::set_normals(std::span<const float> normals, std::span<const PointRange> changed) {
    State& s = *state_;
    require(normals.empty() || normals.size() == 3 * s.n, "three numbers a normal");
    if (!normals.empty()) s.splats->set_normals(normals, s.chunks_to_take(!s.has_normals, changed));
    s.has_normals = !normals.empty();
    ++s.points_version;
}

PointRenderer::DrawnBuffers PointRenderer::buffers_to_write() {
    State& s = *state_;
    const DrawnBuffers buffers = s.splats->buffers();
    if (!s.has_positions || buffers.positions == 0) return {};
    glFinish();
    return {buffers.positions, s.has_normals ? buffers.normals : 0};
}

void PointRenderer::note_written(std::span<const std::array<float, 6>> boxes, std::size_t points_in_box) {
    State& s = *state_;
    require(boxes.size() == (s.n + points_in_box - 1) / points_in_box, "a box for all points");
    join_boxes(boxes, points_in_box, s.chunks);
    ++s.points_version;
}

void PointRenderer::set_colors(std::span<const std::uint32_t> rgba) {
    require(rgba.size() == state_->n, "a colour a point");
    state_->colors.assign(rgba.begin(), rgba.end());
    state_->tints_are_stale = true;
    ++state_->points_version;
}

void PointRenderer::set_spacings(std::span<const float> spacings) {
    State& s = *state_;
    require(spacings.empty() || spacings.size() == s.n, "a spacing a point");
    std::vector<std::uint8_t> widths(spacings.size());
    s.widest_width = 0;
    for (std::size_t i = 0; i < widths.size(); ++i) {
        const double wider = std::clamp(static_cast<double>(spacings[i]) / s.spacing, 1.0, most_wider);
        widths[i] = static_cast<std::uint8_t>(std::lround(widths_in_double * std::log2(wider)));
        s.widest_width = std::max(s.widest_width, widths[i]);
    }
    s.splats->set_widths(widths);
    ++s.points_version;
}

void PointRenderer::set_marks(std::span<const std::uint8_t> marks) {
    require(marks.empty() || marks.size() == state_->n, "a mark a point");
    state_->marks.assign(marks.begin(), marks.end());
    state_->tints_are_stale = true;
    ++state_->points_version;
}

void PointRenderer::set_handle_looks(std::span<const HandleLook> looks) {
    state_->looks.assign(looks.begin(), looks.end());
    state_->tints_are_stale = true;
    ++state_->points_version;
}

void PointRenderer::set_overlay(std::span<const OverlayLine> lines) {
    State& s = *state_;
    s.lines.assign(lines.begin(), lines.end());
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
        !s.lines_box || s.lines_box->lowest != box.lowest || s.lines_box->highest != box.highest;
    if (!lines.empty() && is_other) ++s.points_version;
    s.lines_box = lines.empty() ? std::nullopt : std::optional(box);
    if (s.splats->by_processor()) ++s.points_version;
    ++s.overlay_version;
}

DrawResult PointRenderer::draw(const Camera& camera, Viewport viewport, const PointLook& look,
                               std::size_t budget, const PictureTarget& target) {
    State& s = *state_;
    for (const GLenum what : {GL_SCISSOR_TEST, GL_BLEND, GL_CULL_FACE, GL_DEPTH_TEST, GL_STENCIL_TEST})
        glDisable(what);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    const DrawResult result = s.draw({camera, viewport, look, s.points_version}, budget);
    const Viewport size = target.size.width > 0 ? target.size : viewport;
    const bool same_size = size.width == viewport.width && size.height == viewport.height;
    const int low = s.splats->by_processor() ? viewport.height : 0;
    glBindFramebuffer(GL_READ_FRAMEBUFFER, *s.finished.framebuffer);
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

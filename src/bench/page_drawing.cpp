#include "bench/page_drawing.h"

#include "base/error.h"

#ifdef KNEAD_HAS_EDITOR

#include "graph/local_spacing.h"
#include "graph/shading_normals.h"
#include "render/png.h"
#include "view/coloring.h"
#include "view/framing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>

namespace knead {

namespace {

// Dark on light, and told apart by those who see few colours: what is free, what stays, what moves.
constexpr glm::vec3 free_color{0.80f, 0.79f, 0.76f};
constexpr std::array<glm::vec3, 4> handle_colors{
    glm::vec3{0.33f, 0.43f, 0.62f}, glm::vec3{0.93f, 0.56f, 0.19f}, glm::vec3{0.80f, 0.33f, 0.25f},
    glm::vec3{0.55f, 0.65f, 0.25f}};

PointLook light_look() {
    PointLook look;
    look.background_top = look.background_bottom = glm::vec3(1.0f);
    return look;
}

Camera camera_of(const PageView& view) {
    constexpr double radian = std::numbers::pi / 180;
    Camera camera = first_view({}, view.size, view.up);
    look_at_side(camera, Side::front);
    const glm::dvec3 upwards = view.up == UpAxis::y ? glm::dvec3(0, 1, 0) : glm::dvec3(0, 0, 1);
    camera.orientation = glm::angleAxis(view.azimuth * radian, upwards) * camera.orientation *
                         glm::angleAxis(-view.elevation * radian, glm::dvec3(1, 0, 0));
    frame_points(camera, view.framed, view.size);
    return camera;
}

constexpr glm::vec3 line_color{0.22f, 0.27f, 0.36f};

std::uint32_t word_of(const glm::vec3& color) {
    std::array<std::uint8_t, 4> bytes{0, 0, 0, 255};
    for (int c = 0; c < 3; ++c)
        bytes[static_cast<std::size_t>(c)] = static_cast<std::uint8_t>(std::lround(255 * color[c]));
    std::uint32_t word = 0;
    std::memcpy(&word, bytes.data(), sizeof word);
    return word;
}

std::vector<std::uint32_t> colors_of(const PageShape& shape) {
    std::vector<std::uint32_t> colors(shape.positions.size() / 3, word_of(free_color));
    for (std::size_t i = 0; i < colors.size(); ++i) {
        if (!shape.values.empty())
            colors[i] = word_of(viridis(double{shape.values[i]} / shape.largest_value));
        else if (!shape.handle.empty() && shape.handle[i] != no_index)
            colors[i] = word_of(handle_colors[shape.handle[i] % handle_colors.size()]);
    }
    return colors;
}

std::vector<OverlayLine> overlay_of(const PageShape& shape) {
    const auto place = [](const Vec3f& p) { return glm::vec3(p.x(), p.y(), p.z()); };
    std::vector<OverlayLine> lines;
    for (const PageLine& line : shape.lines)
        lines.push_back({place(line.from), place(line.to),
                         word_of(line.strong ? handle_colors[2] : line_color), line.width});
    return lines;
}

} // namespace

struct PageDrawer::State {
    explicit State(Workers& with) : workers(with) {}
    Workers& workers;
    HeadlessContext context;
    PointRenderer renderer;
    std::vector<float> normals; // that the renderer has
};

PageDrawer::PageDrawer(Workers& workers) : state_(std::make_unique<State>(workers)) {}
PageDrawer::~PageDrawer() = default;

void PageDrawer::draw(const std::filesystem::path& file, const PageShape& shape, const PageView& view) {
    State& s = *state_;
    s.renderer.set_points(shape.positions.size() / 3, usual_spacing(shape.opened));
    s.renderer.set_spacings(spacing_of_points(*shape.order, *shape.graph, shape.opened, s.workers));
    s.renderer.set_positions(shape.positions);
    if (!shape.solid) {
        const std::vector<float> vertices = vertex_positions(*shape.order, shape.positions, s.workers);
        s.normals = spread_to_points(shading_normals(*shape.graph, vertices, s.workers), shape.order->vertex);
        s.renderer.set_normals(s.normals);
    }
    s.renderer.set_colors(colors_of(shape));
    s.renderer.set_overlay(overlay_of(shape));
    write_png(file, draw_picture(s.renderer, camera_of(view), view.size, light_look()));
}

} // namespace knead

#else

namespace knead {

struct PageDrawer::State {};

PageDrawer::PageDrawer(Workers& /*workers*/) {
    throw Error(
        Trouble::usage, "",
        "this knead was built without OpenGL (KNEAD_EDITOR=OFF) and draws no pictures; the page needs "
        "a full build");
}
PageDrawer::~PageDrawer() = default;
void PageDrawer::draw(const std::filesystem::path& /*file*/, const PageShape& /*shape*/,
                      const PageView& /*view*/) {}

} // namespace knead

#endif

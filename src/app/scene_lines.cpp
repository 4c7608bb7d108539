#include "app/scene_lines.h"

#include "view/framing.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

namespace {

constexpr std::uint32_t rgba(unsigned red, unsigned green, unsigned blue, unsigned alpha) {
    return red | green << 8 | blue << 16 | alpha << 24;
}

// A grid on the ground, of round steps; the axes through its middle are tinted.
void add_ground(const Editor& editor, std::vector<OverlayLine>& lines) {
    const Box3 box = bulk_box(editor.opened.opened->positions); // stray points below do not lower the ground
    const glm::dvec3 middle = (box.lowest + box.highest) / 2.0;
    const Upward up = upward(editor.camera.up);
    const glm::length_t along = 3 - up.axis; // across and along the ground: x and y, or x and z
    const double ground = up.sign > 0 ? box.lowest[up.axis] : box.highest[up.axis];
    const double reach = std::max(glm::distance(box.lowest, box.highest), 1e-9);
    const double step = std::pow(10.0, std::floor(std::log10(reach / 3)));
    const double fine = reach / step > 15 ? 2 * step : step;
    const int count = static_cast<int>(std::ceil(reach / fine));
    const auto point = [&](double x, double y) {
        glm::vec3 place(static_cast<float>(x));
        place[along] = static_cast<float>(y);
        place[up.axis] = static_cast<float>(ground);
        return place;
    };
    const double x0 = std::round(middle.x / fine) * fine, y0 = std::round(middle[along] / fine) * fine;
    const double half = count * fine;
    const std::uint32_t middle_color = along == 2 ? rgba(75, 125, 220, 120) : rgba(100, 165, 60, 120);
    for (int i = -count; i <= count; ++i) {
        // Fainter towards the ends.
        const double fade = 1 - std::abs(static_cast<double>(i)) / (count + 1);
        const auto alpha = static_cast<unsigned>(20 + 45 * fade);
        const std::uint32_t gray = rgba(190, 200, 215, alpha);
        lines.push_back({point(x0 - half, y0 + i * fine), point(x0 + half, y0 + i * fine),
                         i == 0 ? rgba(200, 70, 75, 120) : gray, 1});
        lines.push_back({point(x0 + i * fine, y0 - half), point(x0 + i * fine, y0 + half),
                         i == 0 ? middle_color : gray, 1});
    }
}

// Where a vertex of the graph is now.
glm::vec3 place_of(const Editor& editor, Index vertex) {
    const float* p =
        editor.frame.positions().data() + 3 * std::size_t{editor.opened.order->first_point[vertex]};
    return {p[0], p[1], p[2]};
}

bool is_hidden(const Editor& editor, Index vertex) {
    return (editor.marks[editor.opened.order->first_point[vertex]] & mark_hidden) != 0;
}

void add_links(const Editor& editor, const SceneLinesOf& what, std::vector<OverlayLine>& lines) {
    const std::vector<Index>& vertices = *what.sample_vertices;
    const Graph& graph = *what.sample_graph;
    const std::size_t count = std::min(vertices.size(), graph.size());
    for (std::size_t s = 0; s < count; ++s)
        for (const Index other : graph.row(s))
            if (s < other && !is_hidden(editor, vertices[s]) &&
                !is_hidden(editor, vertices[other])) // each once
                lines.push_back({place_of(editor, vertices[s]), place_of(editor, vertices[other]),
                                 rgba(120, 215, 255, 130), 1});
}

void add_samples(const Editor& editor, const SceneLinesOf& what, std::vector<OverlayLine>& lines) {
    for (const Index vertex : *what.sample_vertices) {
        if (is_hidden(editor, vertex)) continue;
        const glm::vec3 place = place_of(editor, vertex);
        lines.push_back({place, place, rgba(10, 14, 20, 220), 6.5f});
        lines.push_back({place, place, rgba(245, 250, 255, 255), 4});
    }
}

// Of each value of mark_handle, whether points that have it can move: those of no handle, or where there is a
// region of interest, its own.
std::array<bool, mark_handle + 1> free_marks(const std::vector<Handle>& handles) {
    std::array<bool, mark_handle + 1> free{true};
    for (std::size_t h = 0; h < handles.size(); ++h) {
        if (handles[h].role != HandleRole::region_of_interest) continue;
        free[0] = false;
        free[handle_mark(h)] = true;
    }
    return free;
}

// Where the handle's pull is, and how strong. What cannot move it does not pull.
void add_halo(const Editor& editor, const SceneLinesOf& what, std::vector<OverlayLine>& lines) {
    const auto free = free_marks(editor.document->handles);
    for (const HaloDot& dot : *what.halo) {
        const std::uint8_t mark = editor.marks[editor.opened.order->first_point[dot.vertex]];
        if ((mark & mark_hidden) != 0 || !free[mark & mark_handle]) continue;
        const glm::vec3 place = place_of(editor, dot.vertex);
        const float strength = 0.3F + 0.7F * dot.nearness * dot.nearness;
        const auto alpha = static_cast<std::uint32_t>(255 * strength);
        lines.push_back({place, place, rgba(10, 14, 20, alpha / 2), 5.5F});
        lines.push_back({place, place, what.halo_color | alpha << 24, 3.5F});
    }
}

// The edges of the plane across which moves are mirrored, around the cloud as it was opened.
void add_mirror(const Editor& editor, const SceneLinesOf& what, std::vector<OverlayLine>& lines) {
    Box3 box = bulk_box(editor.opened.opened->positions);
    const glm::dvec3 margin((box.highest - box.lowest) * 0.06);
    box = {box.lowest - margin, box.highest + margin};
    const int axis = *what.mirror_axis;
    box.lowest[axis] = box.highest[axis] = what.mirror_at;
    const int across = (axis + 1) % 3;
    glm::dvec3 one = box.lowest, other = box.highest;
    std::swap(one[across], other[across]);
    const glm::vec3 corners[] = {box.lowest, one, box.highest, other};
    for (std::size_t k = 0; k < 4; ++k)
        lines.push_back({corners[k], corners[(k + 1) % 4], rgba(120, 215, 255, 110), 1.5F});
}

// The ground would be one bright line, across the feet of what stands there.
bool is_seen_edge_on(const Camera& camera) {
    const Upward up = upward(camera.up);
    const glm::dmat4 view = view_matrix(camera);
    return camera.orthographic && std::abs(view[up.axis][2]) < 0.02;
}

} // namespace

SceneLinesOf scene_lines_of(const Editor& editor, const Display& display,
                            std::shared_ptr<const std::vector<HaloDot>> halo, std::uint32_t halo_color) {
    SceneLinesOf what;
    what.grid = display.grid && !is_seen_edge_on(editor.camera);
    what.up = editor.camera.up;
    if (editor.symmetry && display.handles) {
        what.mirror_axis = editor.symmetry->axis;
        what.mirror_at = editor.symmetry->at;
    }
    const DocumentView& document = *editor.document;
    const bool there = document.sample_vertices && document.sample_vertices->size() <= most_shown_samples;
    what.samples = there && display.samples;
    what.links = there && display.sample_graph && document.sample_graph;
    what.halo = std::move(halo);
    if (what.halo) what.halo_color = halo_color;
    if (what.samples || what.links || what.halo) what.version = editor.frame.version;
    if (!what.samples && !what.links) return what;
    what.sample_vertices = document.sample_vertices;
    what.sample_graph = document.sample_graph;
    return what;
}

std::vector<OverlayLine> scene_lines(const Editor& editor, const SceneLinesOf& what) {
    std::vector<OverlayLine> lines;
    if (what.grid) add_ground(editor, lines);
    if (what.mirror_axis) add_mirror(editor, what, lines);
    if (what.links) add_links(editor, what, lines);
    if (what.samples) add_samples(editor, what, lines);
    if (what.halo) add_halo(editor, what, lines);
    return lines;
}

} // namespace knead

#include "app/scene.h"

#include "app/estimated_normals.h"
#include "app/scene_lines.h"

#include <algorithm>

namespace knead {

struct Scene::State {
    PointRenderer renderer;
    // As handed to the renderer last.
    Coloring coloring{};
    std::vector<std::uint8_t> marks; // as drawn
    bool tints = true;               // handles are tinted
    std::string attribute;
    bool automatic_range = true;
    ValueRange range;
    bool colored = false;
    bool parts_known = false;
    std::shared_ptr<const std::vector<float>> spacings;
    UpAxis up = UpAxis::z;
    SceneLinesOf lines;
    std::uint64_t version = 0; // of the frame
    std::vector<PointRange> moved;
    EstimatedNormals estimated;
    bool lit = false; // by them
    std::vector<HandleLook> looks;
    std::vector<std::uint32_t> colors;
};

Scene::Scene() : state_(std::make_unique<State>()) {}
Scene::~Scene() = default;

namespace {

HandleLook::Pattern pattern_of(HandleRole role) {
    switch (role) {
    case HandleRole::moving:
        return HandleLook::Pattern::solid;
    case HandleRole::fixed:
        return HandleLook::Pattern::stripes;
    default:
        return HandleLook::Pattern::dots;
    }
}

std::vector<HandleLook> looks_of(const Editor& editor, const UiState& state) {
    std::vector<HandleLook> looks;
    const std::vector<Handle>& handles = editor.document->handles;
    for (std::size_t i = 0; i < handles.size(); ++i) {
        const ImVec4 color =
            as_vector(handle_color(state.handle_colors, handles[i].name, i, handles[i].role));
        looks.push_back({{color.x, color.y, color.z}, pattern_of(handles[i].role)});
    }
    return looks;
}

bool same(const std::vector<HandleLook>& a, const std::vector<HandleLook>& b) {
    return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const HandleLook& x, const HandleLook& y) {
        return x.color == y.color && x.pattern == y.pattern;
    });
}

} // namespace

void Scene::take_in(Editor& editor, UiState& state) {
    if (!editor.document) return;
    State& own = *state_;
    const Display& display = state.display;
    EditorChanges& changes = editor.changes;
    if (changes.cloud) {
        if (display.coloring == Coloring::attribute) // of the cloud before
            state.display.coloring = Coloring::file;
        own.renderer.set_points(editor.marks.size(), editor.opened.spacing);
        own.spacings.reset();
        own.colored = false;
        own.looks.clear();
        own.lines = {};
        own.renderer.set_overlay({});
        own.estimated.begin_anew();
        own.lit = false;
        own.version = 0;
    }
    if (changes.cloud || changes.positions) {
        changed_since(own.version, editor.frame, own.moved);
        own.renderer.set_positions(editor.frame.positions, own.moved);
        if (!editor.frame.normals.empty()) own.renderer.set_normals(editor.frame.normals, own.moved);
        own.version = editor.frame.version;
        if (follows_pose(display.coloring)) own.colored = false;
    }
    // Where colours tell a value, a handle's tint would tell another.
    const bool tints = !tells_number(display.coloring) && display.coloring != Coloring::parts;
    if (changes.cloud || changes.marks || tints != own.tints) {
        own.tints = tints;
        own.marks = editor.marks;
        if (!tints)
            for (std::uint8_t& mark : own.marks) mark = static_cast<std::uint8_t>(mark & ~mark_handle);
        own.renderer.set_marks(own.marks);
    }
    changes = {false, false, false};
    if (std::vector<HandleLook> looks = looks_of(editor, state); !same(looks, own.looks)) {
        own.looks = std::move(looks);
        own.renderer.set_handle_looks(own.looks);
    }
    const bool graph_came = !own.parts_known && editor.document->components != nullptr;
    own.parts_known = editor.document->components != nullptr;
    if (own.spacings != editor.document->spacings) {
        own.spacings = editor.document->spacings;
        own.renderer.set_spacings(own.spacings ? std::span<const float>(*own.spacings)
                                               : std::span<const float>());
    }
    const bool needs_graph = display.coloring == Coloring::stretch || display.coloring == Coloring::parts;
    if (!own.colored || own.coloring != display.coloring || own.attribute != display.attribute ||
        own.automatic_range != display.automatic_range || own.up != editor.camera.up ||
        !(own.range == display.range) || (graph_came && needs_graph)) {
        state.legend = color_points(display, editor, own.colors);
        own.renderer.set_colors(own.colors);
        own.colored = true;
        own.coloring = display.coloring;
        own.attribute = display.attribute;
        own.automatic_range = display.automatic_range;
        own.range = display.range;
        own.up = editor.camera.up;
    }
    if (SceneLinesOf lines = scene_lines_of(editor, display); !(lines == own.lines)) {
        own.lines = std::move(lines);
        own.renderer.set_overlay(scene_lines(editor, own.lines));
    }
    own.estimated.look_at(editor, display.look.shading, ImGui::GetTime());
    const auto normals = own.estimated.take();
    if (own.lit && own.estimated.outdated()) own.renderer.set_normals({});
    own.lit &= !own.estimated.outdated();
    if (normals && !own.estimated.outdated()) {
        own.renderer.set_normals(*normals);
        own.lit = true;
    }
}

DrawResult Scene::draw(const Editor& editor, PointLook look, std::size_t budget, bool coarse, int left,
                       int bottom) {
    PictureTarget target(0);
    target.left = left;
    target.bottom = bottom;
    target.size = editor.viewport;
    Viewport viewport = editor.viewport;
    if (coarse) {
        viewport = {std::max(1, viewport.width / 2), std::max(1, viewport.height / 2)};
        look.pixel_scale /= 2;
    }
    return state_->renderer.draw(editor.camera, viewport, look, budget, target);
}

bool Scene::is_drawn_in_software() const {
    return state_->renderer.is_software();
}

bool Scene::expects_more() const {
    return state_->estimated.expected();
}

} // namespace knead

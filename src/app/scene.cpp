#include "app/scene.h"

#include "app/estimated_normals.h"
#include "app/scene_lines.h"
#include "upsample/drawing.h"
#include "upsample/point_blocks.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace knead {

namespace {

// What the colours tell.
struct ColoredBy {
    Coloring coloring{};
    std::string attribute;
    bool automatic_range = true;
    ValueRange range;
    UpAxis up = UpAxis::z;
    bool operator==(const ColoredBy&) const = default;
};

} // namespace

struct Scene::State {
    PointRenderer renderer;
    // As handed to the renderer last.
    std::optional<ColoredBy> colored;
    bool parts_known = false;
    bool marks_changed = false; // what is hidden, or who holds what
    std::shared_ptr<const std::vector<float>> spacings;
    SceneLinesOf lines;
    std::uint64_t version = 0;               // of the frame
    std::shared_ptr<const RestShape> handed; // whose points the renderer has a view of
    std::vector<PointRange> moved;
    // Moves points where they are drawn, for frames that come so.
    std::unique_ptr<DrawnPoints> drawn = std::make_unique<DrawnPoints>();
    bool drawn_is_newest = false; // nobody else wrote positions since
    bool drawing_failed = false;  // once is enough
    // The renderer has the points as they were opened, and the steps that there were then.
    std::optional<std::pair<std::size_t, std::size_t>> compared_at;
    FalloffHalo halo;
    EstimatedNormals estimated;
    std::vector<float> estimated_normals; // that the renderer has
    bool lit = false;                     // by them
    std::vector<HandleLook> looks;
    std::vector<std::uint32_t> colors;

    void begin_cloud(const Editor& editor, Display& display);
    void compare(const Editor& editor, UiState& state);
    void take_positions(const Editor& editor, UiState& state);
    void upload(const PosedFrame& frame);
    bool move_where_drawn(const PosedFrame& frame, UiState& state);
    bool can_draw_drags(const Editor& editor, const Display& display) const;
    void take_marks(const Editor& editor);
    void take_looks(const Editor& editor, const UiState& state);
    void take_spacings(const DocumentView& document);
    void take_colors(Editor& editor, UiState& state);
    void take_lines(const Editor& editor, const UiState& state);
    void take_estimated_normals(const Editor& editor, const Display& display);
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

// Where the points' colours tell a value, a tint would tell another: handles are told by their patterns
// alone.
HandleLook without_tint(HandleLook look) {
    look.share = 0;
    if (look.pattern == HandleLook::Pattern::solid) look.pattern = HandleLook::Pattern::stripes_and_dots;
    return look;
}

std::vector<HandleLook> looks_of(const Editor& editor, const UiState& state) {
    const Coloring coloring = state.display.coloring;
    const bool tells_value = tells_number(coloring) || coloring == Coloring::parts;
    std::vector<HandleLook> looks;
    for (const Handle& handle : editor.document->handles) {
        const ImVec4 color = as_vector(handle_color(state.handle_colors, handle));
        const HandleLook look{{color.x, color.y, color.z}, pattern_of(handle.role)};
        if (!state.display.handles)
            looks.push_back({look.color, HandleLook::Pattern::solid, 0});
        else
            looks.push_back(tells_value ? without_tint(look) : look);
    }
    return looks;
}

} // namespace

void Scene::State::begin_cloud(const Editor& editor, Display& display) {
    // What the colours told was of the cloud before.
    display.coloring = Display().coloring;
    display.automatic_range = true;
    compared_at.reset();
    drawn = std::make_unique<DrawnPoints>(); // the buffers become others
    drawn_is_newest = false;
    renderer.set_points(editor.marks.size(), editor.opened.spacing);
    spacings.reset();
    colored.reset();
    looks.clear();
    lines = {};
    renderer.set_overlay({});
    halo.begin_anew();
    estimated.begin_anew();
    lit = false;
    version = 0;
}

void Scene::State::take_positions(const Editor& editor, UiState& state) {
    if (!editor.frame.on_device)
        upload(editor.frame);
    else if (!move_where_drawn(editor.frame, state))
        return; // the points come with the next frame
    version = editor.frame.version;
    if (follows_pose(state.display.coloring)) colored.reset();
}

// Shows the cloud as it was opened for as long as it is asked for, and nothing is done to it: whoever selects
// or moves has to see what there is.
void Scene::State::compare(const Editor& editor, UiState& state) {
    const DocumentView& document = *editor.document;
    const std::pair steps(document.undoable_steps, document.redoable_steps);
    const bool is_used = editor.tools.drag || editor.tools.doing == Tools::Doing::selecting;
    if (is_used || editor.changes.cloud || editor.changes.marks || steps != compared_at.value_or(steps))
        state.as_opened = false;
    if (state.as_opened == compared_at.has_value()) return;
    version = 0; // all of the frame's points are others
    drawn_is_newest = false;
    if (state.as_opened) {
        const RestShape& opened = *editor.opened.opened;
        renderer.set_positions(opened.positions);
        if (!opened.normals.empty()) renderer.set_normals(opened.normals);
        compared_at = steps;
    } else {
        compared_at.reset();
        take_positions(editor, state);
    }
}

void Scene::State::upload(const PosedFrame& frame) {
    changed_since(version, frame, moved);
    renderer.set_positions(frame.positions(), moved);
    handed = frame.shape;
    if (!frame.normals().empty()) renderer.set_normals(frame.normals(), moved);
    drawn_is_newest = false;
}

// False where the device cannot.
bool Scene::State::move_where_drawn(const PosedFrame& frame, UiState& state) {
    if (drawing_failed) return false;
    const PointRenderer::DrawnBuffers buffers = renderer.buffers_to_write();
    if (buffers.positions == 0) return false;
    try {
        drawn->move(*frame.on_device, {buffers.positions, frame.normals().empty() ? 0 : buffers.normals},
                    drawn_is_newest ? Held::last_frame : Held::nothing);
    } catch (const DeviceFailure& failure) {
        drawing_failed = true;
        drawn = std::make_unique<DrawnPoints>();
        drawn_is_newest = false;
        version = 0; // the buffers may have anything
        add_toast(state, {Notice::Kind::warning,
                          std::string("The graphics card cannot move points where it draws them (") +
                              failure.what() + "); they go by way of the processor from here on."});
        return false;
    }
    drawn_is_newest = true;
    renderer.note_written(drawn->boxes(), points_in_block);
    return true;
}

// Whether nothing else that is shown needs to know where the points are. Once the hand has let go, anything
// may be asked of them.
bool Scene::State::can_draw_drags(const Editor& editor, const Display& display) const {
    return !drawing_failed && !renderer.is_software() && !(editor.drag && editor.drag->ended) &&
           !follows_pose(display.coloring) && !display.samples && !display.sample_graph &&
           !estimated.made_in_motion(editor, display.look.shading);
}

void Scene::State::take_marks(const Editor& editor) {
    if (editor.changes.cloud || editor.changes.marks) renderer.set_marks(editor.marks);
}

void Scene::State::take_looks(const Editor& editor, const UiState& state) {
    std::vector<HandleLook> now = looks_of(editor, state);
    if (now == looks) return;
    looks = std::move(now);
    renderer.set_handle_looks(looks);
}

void Scene::State::take_spacings(const DocumentView& document) {
    if (spacings == document.spacings) return;
    spacings = document.spacings;
    renderer.set_spacings(spacings ? std::span<const float>(*spacings) : std::span<const float>());
}

void Scene::State::take_colors(Editor& editor, UiState& state) {
    const Display& display = state.display;
    const bool needs_graph = display.coloring == Coloring::stretch || display.coloring == Coloring::parts;
    const bool graph = editor.document->components != nullptr;
    if (graph && !parts_known && needs_graph) colored.reset();
    parts_known = graph;
    ColoredBy now{display.coloring, display.attribute, display.automatic_range, display.range,
                  editor.camera.up};
    if (colored == now) return;
    state.legend = color_points(display, editor, colors);
    renderer.set_colors(colors);
    colored = std::move(now);
}

void Scene::State::take_lines(const Editor& editor, const UiState& state) {
    halo.look_at(editor, state.display.handles && !compared_at);
    const bool is_dragged = editor.drag && !editor.drag->ended; // then the shape itself tells
    const Handle* const chosen = chosen_handle(editor);
    const std::uint32_t color = chosen ? handle_color(state.handle_colors, *chosen) & 0xffffffU : 0;
    SceneLinesOf now = scene_lines_of(editor, state.display, is_dragged ? nullptr : halo.dots(), color);
    const bool shows_and_hides = marks_changed && (now.samples || now.links || now.halo);
    if (now == lines && !shows_and_hides) return;
    lines = std::move(now);
    renderer.set_overlay(scene_lines(editor, lines));
}

void Scene::State::take_estimated_normals(const Editor& editor, const Display& display) {
    estimated.look_at(editor, display.look.shading, ImGui::GetTime());
    auto normals = estimated.take();
    if (lit && estimated.outdated()) renderer.set_normals({});
    lit &= !estimated.outdated();
    if (normals && !estimated.outdated()) {
        estimated_normals = std::move(*normals);
        renderer.set_normals(estimated_normals);
        lit = true;
    }
}

void Scene::take_in(Editor& editor, UiState& state) {
    if (!editor.document) return;
    State& own = *state_;
    if (editor.changes.cloud) own.begin_cloud(editor, state.display);
    own.compare(editor, state);
    if (!own.compared_at && (editor.changes.cloud || editor.changes.positions))
        own.take_positions(editor, state);
    own.take_marks(editor);
    own.marks_changed = editor.changes.marks;
    editor.changes = {false, false, false};
    own.take_looks(editor, state);
    own.take_spacings(*editor.document);
    own.take_colors(editor, state);
    own.take_lines(editor, state);
    own.take_estimated_normals(editor, state.display);
    editor.live->draw_drags_on_device(own.can_draw_drags(editor, state.display));
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

Picture Scene::picture(const Editor& editor, PointLook look, bool bare) {
    // Four of them are averaged for each of the picture, where that is not too much to hold at once.
    constexpr std::size_t most_drawn = 32'000'000; // pixels
    Viewport size = editor.viewport;
    if (2 * std::max(size.width, size.height) <= largest_picture) {
        size = {2 * size.width, 2 * size.height};
        look.pixel_scale *= 2;
    }
    const std::size_t pixels = static_cast<std::size_t>(size.width) * static_cast<std::size_t>(size.height);
    PointRenderer& renderer = state_->renderer;
    SceneLinesOf lines = bare ? SceneLinesOf{} : state_->lines;
    lines.mirror_axis.reset(); // a tool, as the gizmo is
    renderer.set_overlay(scene_lines(editor, lines));
    if (bare) {
        std::vector<std::uint8_t> marks(editor.marks.size());
        std::ranges::transform(editor.marks, marks.begin(), [](std::uint8_t mark) {
            return static_cast<std::uint8_t>(mark & mark_hidden);
        });
        renderer.set_marks(marks);
    }
    const auto as_the_window_has_them = [&] {
        renderer.set_overlay(scene_lines(editor, state_->lines));
        if (bare) renderer.set_marks(editor.marks);
    };
    try {
        Picture picture = draw_picture(renderer, editor.camera, size, look, 4 * pixels <= most_drawn ? 2 : 1);
        as_the_window_has_them();
        return picture;
    } catch (...) { // for a large one there may be no memory
        as_the_window_has_them();
        throw;
    }
}

bool Scene::is_drawn_in_software() const {
    return state_->renderer.is_software();
}

bool Scene::expects_more() const {
    return state_->estimated.expected() || state_->halo.expected();
}

} // namespace knead

// Over the cloud, under the panels: the gizmo, the selection in the making and the axes in the corner; and
// over all of it the amount beside the cursor.

#include "app/overlay.h"

#include "app/axes_corner.h"
#include "app/handle_names.h"
#include "app/icons.h"
#include "app/widgets.h"
#include "edit/selecting.h"
#include "view/amount_text.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace knead {

ImVec2 in_window(const Ui& ui, glm::dvec2 pixel) {
    return {ui.state.view.x + static_cast<float>(pixel.x) / ui.state.pixel_ratio,
            ui.state.view.y + static_cast<float>(pixel.y) / ui.state.pixel_ratio};
}

namespace {

// --- The gizmo ---

ImU32 color_of(const GizmoShape& shape, bool hovered, bool another_is_dragged) {
    if (hovered) return palette::rgb(0xffd24a);
    const ImU32 color = palette::axes[static_cast<std::size_t>(std::clamp(shape.color_axis, 0, 3))];
    return with_alpha(color, another_is_dragged ? 0.25f : shape.behind ? 0.28f : 0.95f);
}

void draw_shape(const Ui& ui, ImDrawList& list, const GizmoShape& shape, ImU32 color, float thickness) {
    for (const glm::dvec2 corner : shape.outline) list.PathLineTo(in_window(ui, corner));
    if (shape.filled && shape.closed) {
        const bool translucent = shape.part.constraint.kind == Constraint::Kind::plane;
        list.PathFillConvex(translucent ? with_alpha(color, 0.45f) : color);
        if (!translucent) return;
        for (const glm::dvec2 corner : shape.outline) list.PathLineTo(in_window(ui, corner));
    }
    list.PathStroke(color, shape.closed ? ImDrawFlags_Closed : ImDrawFlags_None, thickness);
}

void draw_gizmo(const Ui& ui, ImDrawList& list) {
    const std::optional<Gizmo> gizmo = gizmo_of(ui.editor);
    if (!gizmo) return;
    const Tools& tools = ui.editor.tools;
    // Of a handle the constraint's line says it all.
    if (tools.drag && tools.modal && !tools.drags_pivot) return;
    std::vector<GizmoShape> shapes = gizmo_shapes(*gizmo, ui.editor.camera, ui.editor.viewport);
    std::stable_sort(shapes.begin(), shapes.end(),
                     [](const GizmoShape& a, const GizmoShape& b) { return a.depth > b.depth; });
    for (const GizmoShape& shape : shapes) {
        const bool hovered = tools.hovered && *tools.hovered == shape.part;
        const ImU32 color = color_of(shape, hovered, tools.drag.has_value() && !hovered);
        const float thickness = ui.scaled(hovered ? 3.0f : shape.behind ? 1.4f : 2.2f);
        // A dark line beneath keeps it readable on bright clouds.
        if (!shape.filled && !shape.behind)
            draw_shape(ui, list, shape, palette::rgb(0x101114, 90), thickness + ui.scaled(1.6f));
        draw_shape(ui, list, shape, color, thickness);
    }
}

// The axis that a drag keeps to, through the whole view.
void draw_constraint(const Ui& ui, ImDrawList& list) {
    const Tools& tools = ui.editor.tools;
    if (!tools.drag || tools.drag->constraint.kind != Constraint::Kind::axis) return;
    const TransformDrag& drag = *tools.drag;
    glm::dvec3 along(0.0);
    along[drag.constraint.axis] = 1;
    if (drag.constraint.local) along = drag.local_axes * along;
    const Camera& camera = ui.editor.camera;
    const double reach = 4 * camera.distance;
    // In pieces, since its ends may lie behind the eye.
    constexpr int pieces = 64;
    std::optional<ImVec2> before;
    const ImU32 color = with_alpha(palette::axes[static_cast<std::size_t>(drag.constraint.axis)], 0.75f);
    for (int i = 0; i <= pieces; ++i) {
        const double t = (2.0 * i / pieces - 1) * reach;
        const auto projected = project(camera, ui.editor.viewport, drag.pivot + t * along);
        std::optional<ImVec2> here;
        if (projected) here = in_window(ui, projected->pixel);
        if (here && before) list.AddLine(*before, *here, color, ui.scaled(1.3f));
        before = here;
    }
}

// --- Small labels ---

void pill(const Ui& ui, ImDrawList& list, ImVec2 corner, const std::string& words, ImU32 ink, ImU32 back) {
    const ImVec2 size = ImGui::CalcTextSize(words.c_str());
    const float across = ui.scaled(9), down = ui.scaled(5);
    list.AddRectFilled(corner, {corner.x + size.x + 2 * across, corner.y + size.y + 2 * down}, back,
                       ui.scaled(6));
    list.AddText({corner.x + across, corner.y + down}, ink, words.c_str());
}

// Over everything else: what is typed has to be read, be a message there or a panel.
void draw_amount(const Ui& ui) {
    const Tools& tools = ui.editor.tools;
    if (!tools.drag) return;
    const std::string words = amount_text(*tools.drag);
    const ImVec2 cursor = in_window(ui, tools.cursor), window = ImGui::GetIO().DisplaySize;
    const float width = ImGui::CalcTextSize(words.c_str()).x + ui.scaled(20);
    const float x = std::clamp(cursor.x + ui.scaled(20), 0.0f, std::max(0.0f, window.x - width));
    const float y = std::clamp(cursor.y + ui.scaled(16), 0.0f, std::max(0.0f, window.y - ui.scaled(30)));
    pill(ui, *ImGui::GetForegroundDrawList(), {x, y}, words, palette::text, palette::rgb(0x15171a, 225));
}

// All else of the overlay is where the cloud is now.
void draw_compared(const Ui& ui, ImDrawList& list) {
    const std::string words = "As it was opened  ·  O: as it is now";
    const Rectangle& view = ui.state.view;
    const float width = ImGui::CalcTextSize(words.c_str()).x + ui.scaled(18);
    pill(ui, list, {view.x + (view.width - width) / 2, view.y + ui.scaled(14)}, words, palette::accent,
         palette::rgb(0x15171a, 225));
}

// --- The selection in the making ---

ImU32 band_color(SelectMode mode) {
    switch (mode) {
    case SelectMode::add:
        return palette::good;
    case SelectMode::remove:
        return palette::error;
    default:
        return palette::accent;
    }
}

void draw_path(const Ui& ui, ImDrawList& list, std::span<const glm::dvec2> path, bool closed, ImU32 color,
               float thickness) {
    for (const glm::dvec2 corner : path) list.PathLineTo(in_window(ui, corner));
    list.PathStroke(color, closed ? ImDrawFlags_Closed : ImDrawFlags_None, ui.scaled(thickness));
}

void draw_box(const Ui& ui, ImDrawList& list, ImU32 color) {
    const Tools& tools = ui.editor.tools;
    const ImVec2 a = in_window(ui, tools.band.front()), b = in_window(ui, tools.cursor);
    const ImVec2 low(std::min(a.x, b.x), std::min(a.y, b.y)), high(std::max(a.x, b.x), std::max(a.y, b.y));
    list.AddRectFilled(low, high, with_alpha(color, 0.10f));
    list.AddRect(low, high, color, 0, 0, ui.scaled(1.4f));
}

void draw_polygon(const Ui& ui, ImDrawList& list, ImU32 color) {
    const Tools& tools = ui.editor.tools;
    std::vector<glm::dvec2> path = tools.band;
    path.push_back(tools.cursor);
    draw_path(ui, list, path, false, color, 1.5f);
    if (path.size() > 2) {
        const std::array closing{path.back(), path.front()};
        draw_path(ui, list, closing, false, with_alpha(color, 0.45f), 1.2f);
    }
    for (const glm::dvec2 corner : tools.band)
        list.AddCircleFilled(in_window(ui, corner), ui.scaled(3.5f), color);
}

void draw_band(const Ui& ui, ImDrawList& list) {
    const Tools& tools = ui.editor.tools;
    if (tools.band.empty()) return;
    const ImU32 color = band_color(tools.band_mode);
    switch (tools.select) {
    case SelectTool::box:
        draw_box(ui, list, color);
        break;
    case SelectTool::polygon:
        draw_polygon(ui, list, color);
        break;
    case SelectTool::brush: {
        const float width =
            2 * static_cast<float>(tools.brush_radius) / ui.state.pixel_ratio / ui.state.scale;
        draw_path(ui, list, tools.band, false, with_alpha(color, 0.22f), width);
        break;
    }
    default:
        draw_path(ui, list, tools.band, false, palette::rgb(0x101114, 110), 3.2f);
        draw_path(ui, list, tools.band, false, color, 1.6f);
        if (tools.band.size() > 2) {
            const std::array closing{tools.band.back(), tools.band.front()};
            draw_path(ui, list, closing, false, with_alpha(color, 0.45f), 1.2f);
        }
    }
}

void draw_brush(const Ui& ui, ImDrawList& list) {
    const Tools& tools = ui.editor.tools;
    if (tools.select != SelectTool::brush || tools.drag || tools.hovered || !ui.state.cursor_in_view) return;
    const float radius = static_cast<float>(tools.brush_radius) / ui.state.pixel_ratio;
    const ImVec2 at = in_window(ui, tools.cursor);
    list.AddCircle(at, radius, palette::rgb(0x101114, 120), 0, ui.scaled(3));
    list.AddCircle(at, radius, tools.band.empty() ? palette::accent : band_color(tools.band_mode), 0,
                   ui.scaled(1.4f));
}

// --- Few selected points ---

// So few are hard to see between all the others, which cover them too.
constexpr std::size_t few_points = 8;

void draw_few_selected(const Ui& ui, ImDrawList& list) {
    const Editor& editor = ui.editor;
    if (editor.selected == 0 || editor.selected > few_points) return;
    if (editor.frame.on_device) return; // where they are is known in a moment
    for (const Index i : first_selected(editor.marks, editor.selected)) {
        const float* p = editor.frame.positions().data() + 3 * std::size_t{i};
        const auto seen = project(editor.camera, editor.viewport, {p[0], p[1], p[2]});
        if (!seen) continue;
        const ImVec2 at = in_window(ui, seen->pixel);
        list.AddCircle(at, ui.scaled(7), palette::rgb(0x101114, 150), 0, ui.scaled(3.6f));
        list.AddCircle(at, ui.scaled(7), palette::accent, 0, ui.scaled(1.8f));
    }
}

} // namespace

void draw_overlay(const Ui& ui) {
    if (!ui.has_cloud()) return;
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    const Rectangle& view = ui.state.view;
    list.PushClipRect({view.x, view.y}, {view.x + view.width, view.y + view.height});
    if (ui.state.as_opened) {
        draw_compared(ui, list);
    } else {
        draw_constraint(ui, list);
        draw_handle_names(ui, list);
        draw_gizmo(ui, list);
        draw_few_selected(ui, list);
        draw_band(ui, list);
        draw_brush(ui, list);
    }
    draw_axes(ui, list);
    list.PopClipRect();
    draw_amount(ui);
}

} // namespace knead

#include "app/handle_names.h"

#include "app/axes_corner.h"
#include "app/icons.h"
#include "app/overlay.h"
#include "view/label_layout.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cmath>

namespace knead {

namespace {

// Longer ones end in dots.
constexpr float longest_name = 190;

struct Name {
    std::size_t handle = 0;
    Label label;
};

float icon_size(const Ui& ui) {
    return ui.scaled(11);
}

// While points are being selected, or a session is played, the others only distract.
bool only_the_chosen(const Ui& ui) {
    return !ui.editor.tools.band.empty() || ui.editor.status.playing;
}

// Of the chosen handle's gizmo, in the window's coordinates.
struct GizmoPlace {
    glm::dvec2 center{0.0};
    double radius = 0;
};

std::optional<GizmoPlace> gizmo_place(const Ui& ui) {
    const std::optional<Gizmo> gizmo = gizmo_of(ui.editor);
    if (!gizmo) return std::nullopt;
    const auto projected = project(ui.editor.camera, ui.editor.viewport, gizmo->center);
    if (!projected) return std::nullopt;
    const ImVec2 at = in_window(ui, projected->pixel);
    return GizmoPlace{{static_cast<double>(at.x), static_cast<double>(at.y)},
                      gizmo->size / static_cast<double>(ui.state.pixel_ratio)};
}

std::optional<Name> name_of(const Ui& ui, std::size_t number) {
    const Handle& handle = ui.editor.document->handles[number];
    const bool chosen = handle.name == ui.editor.chosen;
    if (!chosen && (handle.role == HandleRole::region_of_interest || only_the_chosen(ui)))
        return std::nullopt;
    const std::optional<glm::dvec3> middle = middle_of(ui.editor, handle);
    if (!middle) return std::nullopt;
    const auto projected = project(ui.editor.camera, ui.editor.viewport, *middle);
    if (!projected) return std::nullopt;
    const ImVec2 at = in_window(ui, projected->pixel),
                 size = ImGui::CalcTextSize(handle.name.data(), handle.name.data() + handle.name.size());
    const float shown = std::min(size.x, ui.scaled(longest_name));
    Name name{number, {}};
    name.label.anchor = {static_cast<double>(at.x), static_cast<double>(at.y)};
    name.label.size = {static_cast<double>(shown + icon_size(ui) + ui.scaled(19)),
                       static_cast<double>(size.y + ui.scaled(6))};
    // The chosen one's stands above its gizmo, where that is about the handle and not at a joint elsewhere.
    const std::optional<GizmoPlace> gizmo = chosen ? gizmo_place(ui) : std::nullopt;
    if (gizmo && glm::distance(gizmo->center, name.label.anchor) < gizmo->radius)
        name.label.rise = name.label.anchor.y - gizmo->center.y + 1.3 * gizmo->radius +
                          static_cast<double>(ui.scaled(10)) + 0.5 * name.label.size.y;
    return name;
}

LabelBox as_box(const Rectangle& place) {
    const glm::dvec2 corner(static_cast<double>(place.x), static_cast<double>(place.y));
    return {corner, corner + glm::dvec2(static_cast<double>(place.width), static_cast<double>(place.height))};
}

// The gizmo, the legend, the axes, and whatever panels, cards and messages lay over the view in the last
// frame.
std::vector<LabelBox> in_the_way(const Ui& ui) {
    std::vector<LabelBox> boxes;
    if (const std::optional<GizmoPlace> gizmo = gizmo_place(ui))
        boxes.push_back({gizmo->center - 1.15 * gizmo->radius, gizmo->center + 1.15 * gizmo->radius});
    if (ui.state.display.axes) boxes.push_back(as_box(axes_place(ui)));
    if (ui.state.legend.range) boxes.push_back(as_box(ui.state.legend_place));
    for (const ImGuiWindow* window : ImGui::GetCurrentContext()->Windows) {
        const bool shown = window->WasActive && !window->Hidden && !window->IsFallbackWindow;
        // Dialogs dim all behind them, names too.
        constexpr int over = ImGuiWindowFlags_Tooltip | ImGuiWindowFlags_ChildWindow | ImGuiWindowFlags_Modal;
        if (!shown || (window->Flags & over)) continue;
        const ImRect rect = window->Rect();
        boxes.push_back(as_box({rect.Min.x, rect.Min.y, rect.GetWidth(), rect.GetHeight()}));
    }
    return boxes;
}

void draw_name(const Ui& ui, ImDrawList& list, const Name& name, const PlacedLabel& placed) {
    const Handle& handle = ui.editor.document->handles[name.handle];
    const bool chosen = handle.name == ui.editor.chosen;
    const auto point = [](glm::dvec2 p) { return ImVec2(static_cast<float>(p.x), static_cast<float>(p.y)); };
    const ImVec2 corner = point(placed.box.lowest), opposite = point(placed.box.highest);
    const float height = opposite.y - corner.y, icon = icon_size(ui), across = ui.scaled(7);
    const ImU32 color = handle_color(ui.state.handle_colors, handle);
    if (placed.is_led && name.label.rise == 0) {
        const ImVec2 from = point(placed.foot), to = point(name.label.anchor);
        list.AddLine(from, to, palette::rgb(0x101114, 140), ui.scaled(2.6f));
        list.AddLine(from, to, with_alpha(color, 0.85f), ui.scaled(1.2f));
        list.AddCircleFilled(to, ui.scaled(3.4f), palette::rgb(0x101114, 180));
        list.AddCircleFilled(to, ui.scaled(2.4f), color);
    }
    list.AddRectFilled(corner, opposite, palette::rgb(0x15171a, chosen ? 225 : 165), height / 2);
    if (chosen) list.AddRect(corner, opposite, palette::accent, height / 2, 0, ui.scaled(1.2f));
    draw_icon(list, icon_of(handle.role), {corner.x + across + icon / 2, corner.y + height / 2}, icon, color);
    const ImVec2 text(corner.x + across + icon + ui.scaled(5), corner.y + ui.scaled(3));
    const char* const begin = handle.name.data();
    const char* const end = begin + handle.name.size(); // told, or ImGui ends it at "##"
    if (ImGui::CalcTextSize(begin, end).x <= ui.scaled(longest_name))
        return list.AddText(text, palette::text, begin, end);
    const float edge = opposite.x - across;
    ImGui::PushStyleColor(ImGuiCol_Text, palette::text);
    ImGui::RenderTextEllipsis(&list, text, {edge, opposite.y}, edge, edge, begin, end, nullptr);
    ImGui::PopStyleColor();
}

} // namespace

void draw_handle_names(const Ui& ui, ImDrawList& list) {
    if (!ui.state.display.names || ui.editor.frame.positions().empty() || ui.editor.tools.drag) return;
    if (ui.editor.frame.on_device) return; // where the handles are is known in a moment
    ImGui::PushFont(ui.state.fonts.small);
    std::vector<Name> names;
    for (std::size_t i = 0; i < ui.editor.document->handles.size(); ++i)
        if (const std::optional<Name> name = name_of(ui, i)) {
            const bool chosen = ui.editor.document->handles[i].name == ui.editor.chosen;
            names.insert(chosen ? names.begin() : names.end(), *name); // which has the choice
        }
    std::vector<Label> labels;
    labels.reserve(names.size());
    for (const Name& name : names) labels.push_back(name.label);
    const std::vector<PlacedLabel> placed = lay_out_labels(labels, in_the_way(ui), as_box(ui.state.view));
    for (std::size_t i = names.size(); i-- > 0;)
        if (placed[i].shown) draw_name(ui, list, names[i], placed[i]);
    ImGui::PopFont();
}

} // namespace knead

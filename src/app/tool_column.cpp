// The slim column at the left: ways to select, and ways to move a handle.

#include "app/icons.h"
#include "app/ui.h"
#include "app/widgets.h"

#include <algorithm>
#include <iterator>

namespace knead {

namespace {

struct ToolButton {
    SelectTool tool;
    Icon icon;
    const char* words;
};
constexpr ToolButton tools[] = {
    {SelectTool::click, Icon::click, "Click (C): selects the point under the cursor"},
    {SelectTool::box, Icon::box, "Box (B): selects what lies in a rectangle"},
    {SelectTool::lasso, Icon::lasso, "Lasso (Q): selects what you draw a line around"},
    {SelectTool::polygon, Icon::polygon, "Polygon (P): click its corners; Enter or a double click closes it"},
    {SelectTool::brush, Icon::brush, "Brush (K): paints the selection; [ and ] change its size"},
};

// Of what the column is made of, in pixels.
struct Sizes {
    float margin, side, space, gap;
};

// In a low window all of it is smaller, so that no button is cut off.
Sizes sizes_for(const Ui& ui, float height) {
    constexpr Sizes whole{10, 36, 5, 10};
    constexpr int buttons = std::size(tools) + 6, gaps = 3; // as draw_tool_column() has them
    constexpr float needed =
        2 * whole.margin + buttons * (whole.side + whole.space) + gaps * (whole.gap + whole.space);
    const float unit = std::min(ui.scaled(1), height / needed);
    return {whole.margin * unit, whole.side * unit, whole.space * unit, whole.gap * unit};
}

void gap(const Ui& ui, const Sizes& sizes) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x;
    const float y = at.y + sizes.gap / 2;
    ImGui::GetWindowDrawList()->AddLine({at.x + ui.scaled(6), y}, {at.x + width - ui.scaled(6), y},
                                        palette::line);
    ImGui::Dummy({width, sizes.gap});
}

void transform_buttons(const Ui& ui, const Sizes& sizes) {
    const float side = sizes.side;
    const Handle* handle = ui.has_cloud() ? chosen_handle(ui.editor) : nullptr;
    const bool possible = handle && handle->role == HandleRole::moving;
    const auto doing = [&](TransformKind kind) {
        return ui.editor.tools.drag && ui.editor.tools.drag->kind == kind;
    };
    const std::string hint =
        possible ? "" : "\nMake a moving handle of a selection (H), or choose one of the list.";
    ImGui::BeginDisabled(!possible);
    if (icon_button(
            "move", Icon::move, side, doing(TransformKind::translate),
            ("Move the handle (G). Then X, Y or Z for an axis, a number for an exact way." + hint).c_str()))
        ui.wish(WishPress{{key('G'), {}, false}});
    if (icon_button(
            "rotate", Icon::rotate, side, doing(TransformKind::rotate),
            ("Turn the handle (R). Then X, Y or Z for an axis, a number for degrees." + hint).c_str()))
        ui.wish(WishPress{{key('R'), {}, false}});
    if (icon_button("scale", Icon::scale, side, doing(TransformKind::scale),
                    ("Scale the handle (S)." + hint).c_str()))
        ui.wish(WishPress{{key('S'), {}, false}});
    gap(ui, sizes);
    const bool local = ui.editor.local_axes;
    if (icon_button("axes", local ? Icon::local : Icon::world, side, false,
                    local ? "The gizmo has the handle's own axes; click for the world's (,)"
                          : "The gizmo has the world's axes; click for the handle's own (,)"))
        ui.wish(WishLocalAxes{!local});
    if (icon_button("pivot", Icon::pivot, side, ui.editor.tools.move_pivot,
                    "Move the pivot (.), the point that the handle turns about: click where the joint is, or "
                    "drag the arrows"))
        ui.wish(WishMovePivot{!ui.editor.tools.move_pivot});
    ImGui::EndDisabled();
}

} // namespace

void draw_tool_column(const Ui& ui, Rectangle where) {
    ImGui::SetNextWindowPos({where.x, where.y});
    ImGui::SetNextWindowSize({where.width, where.height});
    const Sizes sizes = sizes_for(ui, where.height);
    const float side = sizes.side;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {(where.width - side) / 2, sizes.margin});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, sizes.space});
    ImGui::Begin("tools", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    for (const ToolButton& button : tools)
        if (icon_button(button.words, button.icon, side, ui.editor.tools.select == button.tool, button.words))
            ui.wish(WishSelectTool{button.tool});
    gap(ui, sizes);
    if (icon_button("through", Icon::through, side, ui.editor.tools.through,
                    "Through (T): also selects what lies behind the visible surface"))
        ui.wish(WishThrough{!ui.editor.tools.through});
    gap(ui, sizes);
    transform_buttons(ui, sizes);
    ImGui::End();
    ImGui::PopStyleVar(3);
}

} // namespace knead

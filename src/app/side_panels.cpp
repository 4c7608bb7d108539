// The column at the right: Handles, Transform, Shape, Display.

#include "app/remembered.h"
#include "app/ui.h"
#include "app/widgets.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

// Between two parts, from edge to edge.
void divider(const Ui& ui) {
    const float left = ImGui::GetWindowPos().x, right = left + ImGui::GetWindowWidth();
    const float y = std::round(ImGui::GetCursorScreenPos().y + ui.scaled(6));
    ImGui::GetWindowDrawList()->AddLine({left, y}, {right, y}, palette::window, ui.scaled(2));
    ImGui::Dummy({0, ui.scaled(9)});
}

// Where not all is seen: a bar in the margin at the right. ImGui's own takes room, by which everything would
// become narrower as soon as a part is opened.
void scroll_bar(const Ui& ui) {
    const float farthest = ImGui::GetScrollMaxY();
    if (farthest <= 0) return;
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    const float margin = ImGui::GetStyle().WindowPadding.x, inset = ui.scaled(4);
    const float height = std::max(ui.scaled(24), size.y * size.y / (size.y + farthest));
    const ImVec2 corner(at.x + size.x - margin, at.y + (size.y - height) * ImGui::GetScrollY() / farthest);
    ImGui::PushClipRect(at, {at.x + size.x, at.y + size.y}, false);
    ImGui::SetCursorScreenPos(corner);
    ImGui::InvisibleButton("scroll", {margin, height});
    if (ImGui::IsItemActive())
        ImGui::SetScrollY(ImGui::GetScrollY() + ImGui::GetIO().MouseDelta.y * farthest / (size.y - height));
    const ImGuiCol state = ImGui::IsItemActive()    ? ImGuiCol_ScrollbarGrabActive
                           : ImGui::IsItemHovered() ? ImGuiCol_ScrollbarGrabHovered
                                                    : ImGuiCol_ScrollbarGrab;
    ImGui::GetWindowDrawList()->AddRectFilled({corner.x + inset, corner.y + inset},
                                              {at.x + size.x - inset, corner.y + height - inset},
                                              ImGui::GetColorU32(state), ui.scaled(3));
    ImGui::PopClipRect();
}

// The edge to the view, by which the panels are made wider; a double click makes them as wide as usual.
void grip(const Ui& ui, const Rectangle& where) {
    const ImVec2 begin = ImGui::GetCursorScreenPos();
    ImGui::PushClipRect({where.x, where.y}, {where.x + where.width, where.y + where.height}, false);
    ImGui::SetCursorScreenPos({where.x, where.y});
    ImGui::InvisibleButton("grip", {ui.scaled(5), where.height});
    float& width = ui.state.panel_width;
    if (ImGui::IsItemHovered() || ImGui::IsItemActive()) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
        ImGui::GetWindowDrawList()->AddRectFilled(
            {where.x, where.y}, {where.x + ui.scaled(2), where.y + where.height}, palette::accent);
    }
    std::optional<float>& grabbed = ui.state.panel_grabbed;
    const float cursor = ImGui::GetIO().MousePos.x;
    if (ImGui::IsItemActivated()) grabbed = cursor - where.x;
    if (!ImGui::IsItemActive()) grabbed.reset();
    if (ImGui::IsItemHovered() && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        width = static_cast<float>(Remembered().panel);
        grabbed.reset(); // until the next press
    }
    if (grabbed && cursor - where.x != *grabbed)
        width = (where.x + where.width + *grabbed - cursor) / ui.state.scale;
    width = std::clamp(width, static_cast<float>(least_panel), static_cast<float>(most_panel));
    ImGui::PopClipRect();
    ImGui::SetCursorScreenPos(begin);
}

} // namespace

void draw_side_panels(const Ui& ui, Rectangle where) {
    ImGui::SetNextWindowPos({where.x, where.y});
    ImGui::SetNextWindowSize({where.width, where.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("side", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoBringToFrontOnFocus |
                     ImGuiWindowFlags_NoNav);
    grip(ui, where);
    // Closer than elsewhere, so that all of it is seen on a small display.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, ui.scaled(5)});
    ImGui::PushItemWidth(-1);
    const struct {
        const char* title;
        void (*panel)(const Ui&);
        bool is_needed = false;
    } parts[] = {{"Handles", handles_panel, ui.state.renaming_begins},
                 {"Transform", transform_panel},
                 {"Shape", shape_panel},
                 {"Display", display_panel}};
    bool first = true;
    for (const auto& part : parts) {
        if (!std::exchange(first, false)) divider(ui);
        if (!section(part.title, ui.state.fonts.bold, part.is_needed)) continue;
        ImGui::PushID(part.title);
        part.panel(ui);
        ImGui::PopID();
    }
    ImGui::PopItemWidth();
    scroll_bar(ui);
    ImGui::PopStyleVar();
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace knead

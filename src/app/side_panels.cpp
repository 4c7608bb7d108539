// The column at the right: Handles, Shape, Display.

#include "app/ui.h"
#include "app/widgets.h"

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

} // namespace

void draw_side_panels(const Ui& ui, Rectangle where) {
    ImGui::SetNextWindowPos({where.x, where.y});
    ImGui::SetNextWindowSize({where.width, where.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::Begin("side", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    // Closer than elsewhere, so that all of it is seen on a small display.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, ui.scaled(5)});
    ImGui::PushItemWidth(-1);
    const struct {
        const char* title;
        void (*panel)(const Ui&);
    } parts[] = {{"Handles", handles_panel}, {"Shape", shape_panel}, {"Display", display_panel}};
    bool first = true;
    for (const auto& part : parts) {
        if (!std::exchange(first, false)) divider(ui);
        if (!section(part.title, ui.state.fonts.bold)) continue;
        ImGui::PushID(part.title);
        part.panel(ui);
        ImGui::PopID();
    }
    ImGui::PopItemWidth();
    ImGui::PopStyleVar();
    ImGui::End();
    ImGui::PopStyleVar();
}

} // namespace knead

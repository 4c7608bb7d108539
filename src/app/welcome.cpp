// The empty window: what knead does, and how to begin.

#include "app/icons.h"
#include "app/ui.h"
#include "app/widgets.h"

#include <imgui_internal.h>

#include <algorithm>

namespace knead {

namespace {

void step(const Ui& ui, const char* number, const char* title, const char* words) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float radius = ui.scaled(13), indent = ui.scaled(40);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 middle(at.x + radius, at.y + radius + ui.scaled(2));
    list.AddCircleFilled(middle, radius, with_alpha(palette::accent, 0.18f));
    const ImVec2 size = ImGui::CalcTextSize(number);
    list.AddText({middle.x - size.x / 2, middle.y - size.y / 2}, palette::accent, number);
    ImGui::Indent(indent);
    ImGui::TextUnformatted(title);
    ImGui::SetCursorPosY(ImGui::GetCursorPosY() - ui.scaled(5));
    faint_text(words);
    ImGui::Unindent(indent);
    ImGui::Dummy({0, ui.scaled(2)});
}

void recent_rows(const Ui& ui) {
    const std::vector<std::filesystem::path>& recent = ui.state.recent;
    if (recent.empty()) return;
    ImGui::Dummy({0, ui.scaled(6)});
    caption("Opened last");
    const std::size_t count = std::min<std::size_t>(recent.size(), 4);
    for (std::size_t i = 0; i < count; ++i) {
        ImGui::PushID(static_cast<int>(i));
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float height = ImGui::GetTextLineHeight() + ui.scaled(6);
        ImGui::PushStyleVar(ImGuiStyleVar_SelectableTextAlign, {0.0f, 0.5f});
        const float whole = ImGui::GetContentRegionAvail().x;
        if (ImGui::Selectable("##recent", false, 0, {0, height})) ui.wish(WishOpen{recent[i]});
        ImGui::PopStyleVar();
        explain(recent[i].string());
        const bool session = has_session_extension(recent[i]);
        draw_icon(*ImGui::GetWindowDrawList(), session ? Icon::session : Icon::cloud,
                  {at.x + ui.scaled(10), at.y + height / 2}, ui.scaled(14), palette::accent);
        const std::string folder = recent[i].parent_path().filename().string();
        const float width = ImGui::CalcTextSize(folder.c_str()).x;
        const float end = at.x + whole - width, down = at.y + ui.scaled(3);
        ImGui::GetWindowDrawList()->AddText({end, down}, palette::faint, folder.c_str());
        const float name_end = end - ui.scaled(12);
        ImGui::RenderTextEllipsis(ImGui::GetWindowDrawList(), {at.x + ui.scaled(26), down},
                                  {name_end, at.y + height}, name_end, name_end, recent[i].filename().c_str(),
                                  nullptr, nullptr);
        ImGui::PopID();
    }
}

// In the middle of what the card above leaves; where that is too low for it, it scrolls.
void place_card(const Ui& ui) {
    const Rectangle& view = ui.state.view;
    const float margin = ui.scaled(12);
    const float top = std::max(view.y, ui.state.recovery_end), bottom = view.y + view.height;
    const float width = std::min(ui.scaled(510), view.width * 0.95f);
    ImGui::SetNextWindowPos({view.x + view.width / 2, (top + bottom) / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSizeConstraints({width, 0},
                                        {width, std::max(ui.scaled(60), bottom - top - 2 * margin)});
    ImGui::SetNextWindowSize({width, 0});
}

} // namespace

void draw_welcome(const Ui& ui) {
    if (ui.has_cloud() || ui.editor.opening || ui.state.browser.open_now) return;
    const Rectangle& view = ui.state.view;
    const glm::vec3 top = ui.state.display.look.background_top,
                    bottom = ui.state.display.look.background_bottom;
    const ImU32 sky = ImGui::ColorConvertFloat4ToU32({top.r, top.g, top.b, 1});
    const ImU32 ground = ImGui::ColorConvertFloat4ToU32({bottom.r, bottom.g, bottom.b, 1});
    ImGui::GetBackgroundDrawList()->AddRectFilledMultiColor(
        {view.x, view.y}, {view.x + view.width, view.y + view.height}, sky, sky, ground, ground);
    place_card(ui);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(32), ui.scaled(28)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.scaled(10));
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::raised);
    ImGui::Begin("welcome", nullptr,
                 ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoCollapse |
                     ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus);
    ImGui::PushFont(ui.state.fonts.title);
    ImGui::TextUnformatted("Pose a point cloud");
    ImGui::PopFont();
    faint_text("knead bends, twists and stretches raw scans with handles. The rest of the cloud follows "
               "while you drag; "
               "no mesh is needed.");
    ImGui::Dummy({0, ui.scaled(8)});
    step(ui, "1", "Open a scan", "Drop a point cloud into this window, or press Ctrl+O.");
    step(ui, "2", "Make handles", "Draw around a part: Shift+H holds it fixed, H makes it one that moves.");
    step(ui, "3", "Pose", "Drag the arrows and rings, or press G, R or S. Enter keeps the pose.");
    ImGui::Dummy({0, ui.scaled(6)});
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(12), ui.scaled(9)});
    if (main_button("Open…", {width, 0})) ui.wish(WishBrowse{BrowseFor::open});
    explain("Opens a cloud or a recorded session (Ctrl+O)");
    ImGui::SameLine();
    if (ImGui::Button("Demonstration", {width, 0})) ui.wish(WishDemonstration{true});
    explain("Opens a creature whose handles are already posed, to play with");
    ImGui::PopStyleVar();
    recent_rows(ui);
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
}

} // namespace knead

// F1: every key and every movement of the mouse; and the words about knead.

#include "app/actions.h"
#include "app/widgets.h"

#include <algorithm>
#include <string_view>

namespace knead {

namespace {

constexpr float narrowest_column = 290;

void row(const Ui& ui, const char* keys, const char* label, const char* words) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float keys_width = ui.scaled(150);
    if (*keys) key_caps(ImGui::GetWindowDrawList(), {at.x, at.y - ui.scaled(2)}, keys);
    ImGui::SetCursorScreenPos({at.x + keys_width, at.y});
    wrapped_text(label);
    if (words) explain(words);
    ImGui::SetCursorScreenPos({at.x, std::max(ImGui::GetCursorScreenPos().y, at.y + ui.scaled(24))});
}

void heading(const Ui& ui, std::string_view words) {
    ImGui::Dummy({0, ui.scaled(6)});
    ImGui::PushStyleColor(ImGuiCol_Text, palette::accent);
    ImGui::TextUnformatted(words.data(), words.data() + words.size());
    ImGui::PopStyleColor();
}

void gesture_rows(const Ui& ui) {
    std::string_view group;
    for (const Gesture& gesture : gestures()) {
        if (gesture.group != group) heading(ui, group = gesture.group);
        row(ui, gesture.keys, gesture.words, nullptr);
    }
}

void action_rows(const Ui& ui, std::string_view from, std::string_view to) {
    std::string_view group;
    bool shown = false;
    for (const Action& action : actions()) {
        const std::string_view menu =
            std::string_view(action.menu).substr(0, std::string_view(action.menu).find('/'));
        if (menu == from) shown = true;
        if (menu == to) break;
        if (!shown || !*action.keys) continue;
        if (menu != group) heading(ui, group = menu);
        row(ui, action.keys, action.label, action.words);
    }
}

// As many side by side as there is room for.
void columns(const Ui& ui) {
    const int most = static_cast<int>(ImGui::GetContentRegionAvail().x / ui.scaled(narrowest_column));
    const int count = std::clamp(most, 1, 3);
    if (!ImGui::BeginTable("columns", count, ImGuiTableFlags_SizingStretchSame | ImGuiTableFlags_ScrollY))
        return;
    ImGui::TableNextColumn();
    gesture_rows(ui);
    action_rows(ui, "Session", "none");
    if (count > 1) ImGui::TableNextColumn();
    action_rows(ui, "File", "Handles");
    if (count > 2) ImGui::TableNextColumn();
    action_rows(ui, "Handles", "Session");
    ImGui::EndTable();
}

} // namespace

void draw_help(const Ui& ui) {
    if (!ui.state.show_help) return;
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(ui.scaled(1180), io.DisplaySize.x * 0.95f),
                              std::min(ui.scaled(830), io.DisplaySize.y * 0.94f)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(24), ui.scaled(18)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::raised);
    const bool begun =
        ImGui::Begin("help", nullptr,
                     ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove |
                         ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(2);
    if (begun) {
        ImGui::PushFont(ui.state.fonts.title);
        ImGui::TextUnformatted("Keys and mouse");
        ImGui::PopFont();
        const float side = ImGui::GetFrameHeight();
        ImGui::SameLine(ImGui::GetWindowWidth() - side - ui.scaled(20));
        if (icon_button("close", Icon::close, side, false, "Close (F1 or Esc)") ||
            ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false))
            ui.state.show_help = false;
        columns(ui);
    }
    ImGui::End();
}

void draw_about(const Ui& ui) {
    if (ui.state.show_about) ImGui::OpenPopup("about");
    ui.state.show_about = false;
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y * 0.42f}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({ui.scaled(460), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(24), ui.scaled(20)});
    const bool open = ImGui::BeginPopup("about");
    ImGui::PopStyleVar();
    if (!open) return;
    ImGui::PushFont(ui.state.fonts.title);
    ImGui::TextUnformatted("knead " KNEAD_VERSION);
    ImGui::PopFont();
    wrapped_text("Bends, twists and stretches raw point clouds with handles, in real time and with no mesh. "
                 "After “Efficient Non-Linear Editing of Large Point Clouds”.");
    if (ui.has_cloud()) faint_text("The points are moved on " + ui.editor.document->device + ".");
    ImGui::Dummy({0, ui.scaled(4)});
    // The Enter that chose this in the menu is no answer to it.
    const bool entered = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    if (main_button("Close", {-1, 0}) || (entered && !ImGui::IsWindowAppearing())) ImGui::CloseCurrentPopup();
    ImGui::EndPopup();
}

} // namespace knead

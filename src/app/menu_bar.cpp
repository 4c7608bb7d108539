// The menus: all of app/actions.h, and the files that were opened last.

#include "app/actions.h"
#include "app/widgets.h"

#include <string_view>

namespace knead {

namespace {

void recent_menu(const Ui& ui) {
    if (!ImGui::BeginMenu("Open recent", !ui.state.recent.empty())) return;
    for (const std::filesystem::path& file : ui.state.recent) {
        ImGui::PushID(file.c_str());
        if (ImGui::MenuItem(file.filename().c_str())) ui.wish(WishOpen{file});
        explain(file.string());
        ImGui::PopID();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Forget these")) ui.wish(WishForgetRecent{});
    ImGui::EndMenu();
}

void item(const Ui& ui, const Action& action) {
    const bool possible = action.possible(ui);
    const bool ticked = action.ticked && action.ticked(ui);
    if (ImGui::MenuItem(action.label, *action.keys ? action.keys : nullptr, ticked, possible)) action.act(ui);
    explain(action.words);
}

// The actions that belong to this menu; a menu within it is opened where its first action stands.
void items(const Ui& ui, std::string_view menu) {
    std::string_view inner; // the one whose actions were all shown last
    for (const Action& action : actions()) {
        const std::string_view of = action.menu;
        if (of != menu && !(of.starts_with(menu) && of.substr(menu.size()).starts_with('/'))) continue;
        if (of != menu && of == inner) continue;
        if (action.line_before) ImGui::Separator();
        if (of == menu) {
            item(ui, action);
            if (action.label == std::string_view("Open…")) recent_menu(ui);
        } else {
            inner = of;
            const std::string title(of.substr(menu.size() + 1));
            if (!ImGui::BeginMenu(title.c_str())) continue;
            for (const Action& within : actions())
                if (within.menu == of) item(ui, within);
            ImGui::EndMenu();
        }
    }
}

} // namespace

void draw_menu_bar(const Ui& ui) {
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ui.scaled(10), ui.scaled(7)});
    if (!ImGui::BeginMainMenuBar()) {
        ImGui::PopStyleVar();
        return;
    }
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.scaled(10), ui.scaled(9)});
    for (const char* menu : {"File", "Edit", "Select", "Handles", "View", "Session", "Help"}) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(12), ui.scaled(10)});
        const bool open = ImGui::BeginMenu(menu);
        ImGui::PopStyleVar();
        if (!open) continue;
        items(ui, menu);
        ImGui::EndMenu();
    }
    ImGui::PopStyleVar();
    if (ui.has_cloud()) { // what is open, at the right
        const std::filesystem::path& session = ui.editor.document->session;
        const std::string name = (session.empty() ? ui.editor.opened.file : session).filename().string() +
                                 (has_unsaved_session(ui.editor) ? " *" : "");
        const float width = ImGui::CalcTextSize(name.c_str()).x;
        const float left = ImGui::GetWindowWidth() - width - ui.scaled(22);
        if (left > ImGui::GetCursorPosX()) { // the window's title has it, too
            ImGui::SameLine(left);
            ImGui::PushStyleColor(ImGuiCol_Text, palette::faint);
            ImGui::TextUnformatted(name.c_str());
            ImGui::PopStyleColor();
        }
    }
    ImGui::EndMainMenuBar();
    ImGui::PopStyleVar();
}

} // namespace knead

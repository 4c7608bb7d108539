// The menus: all of app/actions.h, and the files that were opened last.

#include "app/actions.h"
#include "app/widgets.h"

#include <imgui_internal.h>

#include <array>
#include <span>
#include <string_view>
#include <utility>

namespace knead {

namespace {

void recent_menu(const Ui& ui) {
    const bool open = ImGui::BeginMenu("Open recent", !ui.state.recent.empty());
    if (!open) ui.state.menus.at_submenu |= ImGui::IsItemFocused();
    if (!open) return;
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

// The actions that belong to this menu; a menu within it is opened where its first action stands.
void items(const Ui& ui, std::string_view menu) {
    std::string_view inner; // the one whose actions were all shown last
    for (const Action& action : actions()) {
        const std::string_view of = action.menu;
        if (of != menu && !(of.starts_with(menu) && of.substr(menu.size()).starts_with('/'))) continue;
        if (of != menu && of == inner) continue;
        if (action.line_before) ImGui::Separator();
        if (of == menu) {
            menu_item(ui, action);
            if (action.label == std::string_view("Open…")) recent_menu(ui);
            if (action.label == std::string_view("Orthographic")) coloring_menu(ui);
        } else {
            inner = of;
            const std::string title(of.substr(menu.size() + 1));
            const bool open = ImGui::BeginMenu(title.c_str());
            if (!open) ui.state.menus.at_submenu |= ImGui::IsItemFocused();
            if (!open) continue;
            for (const Action& within : actions())
                if (within.menu == of) menu_item(ui, within);
            ImGui::EndMenu();
        }
    }
}

// The next menu, where the keys ask for it.
void go_on(MenuWalk& walk, std::span<const char* const> names) {
    if (walk.step == 0) return;
    const int count = static_cast<int>(names.size());
    const int next = (walk.open + std::exchange(walk.step, 0) + count) % count;
    close_popups();
    ImGui::OpenPopup(names[static_cast<std::size_t>(next)]);
    ImGui::GetCurrentContext()->NavDisableMouseHover = true; // the cursor is where it was before
}

void menus(const Ui& ui) {
    static constexpr std::array names{"File", "Edit", "Select", "Handles", "View", "Session", "Help"};
    MenuWalk& walk = ui.state.menus;
    go_on(walk, names);
    walk.open = -1;
    walk.at_submenu = false;
    for (std::size_t number = 0; number < names.size(); ++number) {
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(12), ui.scaled(10)});
        const bool open = ImGui::BeginMenu(names[number]);
        ImGui::PopStyleVar();
        if (!open) continue;
        walk.open = static_cast<int>(number);
        items(ui, names[number]);
        ImGui::EndMenu();
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
    menus(ui);
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

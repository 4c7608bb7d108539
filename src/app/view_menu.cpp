// The menu that the right button opens in the view: of the handle under the cursor, of what is selected, or
// of the view.

#include "app/actions.h"
#include "app/handle_menu.h"
#include "app/widgets.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace knead {

namespace {

void items(const Ui& ui, const char* menu, std::initializer_list<const char*> labels) {
    for (const char* label : labels) menu_item(ui, action_called(menu, label));
}

void selection_items(const Ui& ui) {
    items(ui, "Handles", {"Moving handle", "Fixed handle", "Region of interest"});
    ImGui::Separator();
    items(ui, "Select", {"Grow", "Shrink", "Connected part", "Invert", "None"});
    ImGui::Separator();
    items(ui, "Select", {"Hide the selection", "Hide the rest"});
    ImGui::Separator();
    items(ui, "View", {"Frame the selection"});
}

void view_items(const Ui& ui) {
    items(ui, "Edit", {"Undo", "Redo"});
    ImGui::Separator();
    items(ui, "Select", {"All", "Show all"});
    ImGui::Separator();
    items(ui, "View", {"Frame everything", "Orthographic"});
    items(ui, "File", {"Save picture…"});
}

} // namespace

void draw_view_menu(const Ui& ui) {
    if (!ui.has_cloud()) return;
    UiState::ViewMenu& menu = ui.state.view_menu;
    if (std::exchange(menu.opens, false)) ImGui::OpenPopup("view menu");
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(12), ui.scaled(10)});
    const bool open = ImGui::BeginPopup("view menu");
    ImGui::PopStyleVar();
    if (!open) return;
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ui.scaled(10), ui.scaled(9)});
    if (const Handle* handle = handle_named(ui.editor.document->handles, menu.handle)) {
        ImGui::TextDisabled("%s", handle->name.c_str());
        ImGui::Separator();
        handle_menu(ui, *handle);
    } else if (ui.editor.selected > 0) {
        selection_items(ui);
    } else {
        view_items(ui);
    }
    ImGui::PopStyleVar();
    ImGui::EndPopup();
}

} // namespace knead

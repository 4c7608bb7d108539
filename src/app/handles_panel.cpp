// The panel "Handles": making handles of the selection, and the list of those there are.

#include "app/handle_colors.h"
#include "app/icons.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

namespace knead {

namespace {

constexpr float fewest_rows = 6;    // of the list
constexpr double most_falloff = 10; // in diagonals of the cloud: what is typed beyond is a slip

void selection_words(const Ui& ui) {
    const std::size_t selected = ui.editor.selected;
    if (selected > 0)
        faint_text(counted(selected, "point") +
                   (selected == 1 ? " selected. Make it a" : " selected. Make them a"));
    else if (ui.editor.document->handles.empty())
        faint_text("Nothing selected. Draw around a part of the cloud with the left button.");
    else
        faint_text("Nothing selected");
}

void selection_buttons(const Ui& ui) {
    selection_words(ui);
    ImGui::BeginDisabled(ui.editor.selected == 0);
    if (key_button("Moving handle", "H", true)) ui.tell(MakeHandle{HandleRole::moving, {}});
    explain("A part that you move, turn and scale; the rest of the cloud follows (H)");
    const float half = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    if (ImGui::Button("Fixed handle", {half, 0})) ui.tell(MakeHandle{HandleRole::fixed, {}});
    explain("A part that stays exactly where it is (Shift+H)");
    ImGui::SameLine();
    if (ImGui::Button("Region", {half, 0})) ui.tell(MakeHandle{HandleRole::region_of_interest, {}});
    explain("The region of interest: only these points may deform, everything else stays (Ctrl+H)");
    ImGui::EndDisabled();
}

void role_items(const Ui& ui, const Handle& handle) {
    const struct {
        HandleRole role;
        const char* label;
    } roles[] = {{HandleRole::moving, "Moving"},
                 {HandleRole::fixed, "Fixed"},
                 {HandleRole::region_of_interest, "Region of interest"}};
    for (const auto& [role, label] : roles)
        if (ImGui::MenuItem(label, nullptr, handle.role == role)) ui.tell(ChangeRole{handle.name, role});
}

void mirror_items(const Ui& ui, const Handle& handle) {
    if (ImGui::MenuItem("Along X")) ui.tell(MirrorHandle{handle.name, 0});
    if (ImGui::MenuItem("Along Y")) ui.tell(MirrorHandle{handle.name, 1});
    if (ImGui::MenuItem("Along Z")) ui.tell(MirrorHandle{handle.name, 2});
}

// What the handle holds.
void point_items(const Ui& ui, const Handle& handle) {
    if (ImGui::MenuItem("Select its points", "Shift+L"))
        ui.tell(SelectHandlePoints{handle.name, SelectMode::replace});
    ImGui::Separator();
    const struct {
        SelectMode mode;
        const char* label;
    } ways[] = {{SelectMode::add, "Add the selection to it"},
                {SelectMode::remove, "Take the selection from it"},
                {SelectMode::replace, "Hold the selection instead"}};
    for (const auto& [mode, label] : ways)
        if (ImGui::MenuItem(label, nullptr, false, ui.editor.selected > 0))
            ui.tell(AssignPoints{handle.name, mode});
}

// How far the handle pulls what is around it, in parts of the cloud's diagonal.
void falloff_menu(const Ui& ui, const Handle& handle) {
    const Bounds& bounds = ui.editor.opened.bounds;
    const double diagonal = (bounds.highest - bounds.lowest).norm();
    const auto pull = [&](double part) {
        ui.tell(ChangeHold{handle.name, handle.free_rotation, part * diagonal});
    };
    const auto words_about = [&](double part) {
        char words[64];
        std::snprintf(words, sizeof words, "%.2g %% of the cloud (%.3g)", 100 * part, part * diagonal);
        return std::string(words);
    };
    const double least = least_falloff(ui.editor, handle) / diagonal;
    const std::string lowest = least > 0 ? "Least: " + words_about(least) : "None";
    if (ImGui::MenuItem(lowest.c_str(), nullptr, handle.falloff <= least * diagonal)) pull(0);
    if (least > 0)
        explain(
            "A handle as small as this pulls at least so far: at a point alone the surface would be drawn "
            "out to a spike");
    for (const double part : {0.02, 0.05, 0.1, 0.2, 0.4}) {
        if (part <= least) continue;
        const bool is_now = std::abs(handle.falloff - part * diagonal) < 1e-9 * diagonal;
        if (ImGui::MenuItem(words_about(part).c_str(), nullptr, is_now)) pull(part);
    }
    ImGui::Separator();
    inline_caption("Length", ui.scaled(70));
    ImGui::SetNextItemWidth(-FLT_MIN);
    double length = std::max(handle.falloff, least * diagonal);
    take_decimal_commas(ImGui::GetID("##length"));
    if (ImGui::InputDouble("##length", &length, 0, 0, "%.4g", ImGuiInputTextFlags_EnterReturnsTrue)) {
        pull(std::clamp(length / diagonal, 0.0, most_falloff));
        ImGui::CloseCurrentPopup();
    }
    explain("In the units of the file; Enter takes it");
}

// What holds, and how.
void hold_items(const Ui& ui, const Handle& handle) {
    if (handle.role == HandleRole::region_of_interest) return;
    if (ImGui::MenuItem("Holds rotation", nullptr, !handle.free_rotation))
        ui.tell(ChangeHold{handle.name, !handle.free_rotation, handle.falloff});
    explain("Off: the handle gives its points their positions only, and the surface turns there as it likes");
    if (ImGui::BeginMenu("Falloff")) {
        falloff_menu(ui, handle);
        ImGui::EndMenu();
    }
    explain("How far along the surface the handle pulls what is around it, the less the farther");
    ImGui::Separator();
}

void handle_menu(const Ui& ui, const Handle& handle) {
    role_items(ui, handle);
    ImGui::Separator();
    hold_items(ui, handle);
    if (ImGui::MenuItem("Rename", "F2")) {
        ui.state.renaming = ui.state.name_text = handle.name;
        ui.state.renaming_begins = true;
    }
    if (ImGui::MenuItem("Colour…")) ui.state.recoloring = handle.name;
    if (ImGui::BeginMenu("Its points")) {
        point_items(ui, handle);
        ImGui::EndMenu();
    }
    if (ImGui::MenuItem("Reset its pose", "Alt+R", false,
                        handle.role == HandleRole::moving && ui.editor.document->posed))
        ui.tell(ResetPose{handle.name});
    if (ImGui::BeginMenu("Mirror")) {
        mirror_items(ui, handle);
        ImGui::EndMenu();
    }
    ImGui::Separator();
    if (ImGui::MenuItem("Delete", "Del")) ui.tell(DeleteHandle{handle.name});
}

// The field in which a name is typed, in place of the name.
void name_field(const Ui& ui, const Handle& handle) {
    UiState& state = ui.state;
    if (state.renaming_begins) ImGui::SetKeyboardFocusHere();
    const bool entered = ImGui::InputText(
        "##name", &state.name_text, ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape));
    const bool left = !state.renaming_begins && ImGui::IsItemDeactivated();
    state.renaming_begins = false;
    if (!entered && !left) return;
    if (!escaped && !state.name_text.empty() && state.name_text != handle.name)
        ui.tell(RenameHandle{handle.name, state.name_text});
    state.renaming.clear();
}

std::string points_of(const Editor& editor, const Handle& handle) {
    const std::size_t all = handle.points->size(), follow = followers_of(editor, handle);
    if (follow >= all || handle.role == HandleRole::region_of_interest) return counted(all, "point");
    return grouped(follow) + " of its " + counted(all, "point") + " (handles made later hold the others)";
}

// What a row of the list reacts to; returns whether the cursor is on it.
bool row_button(const Ui& ui, const Handle& handle, ImVec2 size, bool renaming) {
    if (renaming) {
        ImGui::Dummy(size);
        return false;
    }
    if (ImGui::InvisibleButton("row", size)) ui.tell(ChooseHandle{handle.name});
    const bool hovered = ImGui::IsItemHovered();
    if (hovered && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        ui.state.renaming = ui.state.name_text = handle.name;
        ui.state.renaming_begins = true;
    }
    if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) ui.state.row_at_rest = handle.name;
    if (!hovered && ui.state.row_at_rest == handle.name) ui.state.row_at_rest.clear();
    const bool quiet = ui.editor.tools.drag || ui.state.row_at_rest == handle.name; // it would be in the way
    if (hovered && !quiet && !ImGui::IsPopupOpen("menu"))
        explain(handle.name + ": " + words_for(handle.role) + ", " + points_of(ui.editor, handle) +
                (handle.free_rotation ? ", positions only" : "") +
                (std::max(handle.falloff, least_falloff(ui.editor, handle)) > 0 ? ", with a falloff" : "") +
                "\nClick chooses it, a double click renames it, the right button has more.");
    return hovered;
}

std::uint32_t hexadecimal(ImU32 color) {
    const auto channel = [&](unsigned shift) { return (color >> shift) & 255U; };
    return channel(IM_COL32_R_SHIFT) << 16U | channel(IM_COL32_G_SHIFT) << 8U | channel(IM_COL32_B_SHIFT);
}

// What is tried counts when the hand lets go of it, as one step to undo.
void color_picker(const Ui& ui, const Handle& handle, ImU32 color) {
    HandleColors& colors = ui.state.handle_colors;
    ImVec4 mixed = as_vector(color);
    if (ImGui::ColorPicker3("##picker", &mixed.x,
                            ImGuiColorEditFlags_NoSidePreview | ImGuiColorEditFlags_NoInputs))
        colors.tried = {handle.name, ImGui::ColorConvertFloat4ToU32(mixed)};
    if (ImGui::IsItemDeactivatedAfterEdit() && colors.tried)
        ui.tell(ColorHandle{handle.name, hexadecimal(colors.tried->color)});
    if (!ImGui::Button("Usual colour", {-1, 0})) return;
    colors.tried.reset();
    ui.tell(ColorHandle{handle.name, std::nullopt});
}

// The square in the handle's colour, and while its menu asks for that, the picker.
void color_swatch(const Ui& ui, const Handle& handle, ImVec2 middle) {
    const ImU32 color = handle_color(ui.state.handle_colors, handle);
    const float half = ui.scaled(6);
    ImGui::GetWindowDrawList()->AddRectFilled({middle.x - half, middle.y - half},
                                              {middle.x + half, middle.y + half}, color, ui.scaled(3));
    if (ImGui::BeginPopup("color")) {
        color_picker(ui, handle, color);
        ImGui::EndPopup();
    } else if (auto& tried = ui.state.handle_colors.tried; tried && tried->handle == handle.name) {
        tried.reset();
    }
}

void handle_row(const Ui& ui, const Handle& handle, std::size_t number) {
    ImGui::PushID(static_cast<int>(number));
    const bool chosen = handle.name == ui.editor.chosen;
    const float height = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool renaming = ui.state.renaming == handle.name;
    const bool hovered = row_button(ui, handle, {width - height, height}, renaming);
    if (chosen || hovered)
        list.AddRectFilled(corner, {corner.x + width, corner.y + height},
                           chosen ? palette::field_pressed : palette::rgb(0xffffff, 14), ui.scaled(5));
    if (chosen)
        list.AddRectFilled(corner, {corner.x + ui.scaled(3), corner.y + height}, palette::accent,
                           ui.scaled(2));
    const float middle = corner.y + height / 2;
    color_swatch(ui, handle, {corner.x + ui.scaled(18), middle});
    draw_icon(list, icon_of(handle.role), {corner.x + ui.scaled(40), middle}, ui.scaled(13), palette::text);
    const float text = ui.scaled(56);
    if (renaming) {
        ImGui::SetCursorScreenPos({corner.x + text - ImGui::GetStyle().FramePadding.x, corner.y});
        ImGui::SetNextItemWidth(width - text - height);
        name_field(ui, handle);
    } else {
        const float end = corner.x + width - height - ui.scaled(4);
        const float top = middle - ImGui::GetFontSize() / 2;
        ImGui::RenderTextEllipsis(&list, {corner.x + text, top}, {end, corner.y + height}, end, end,
                                  handle.name.c_str(), nullptr, nullptr);
    }
    ImGui::SetCursorScreenPos({corner.x + width - height, corner.y});
    if (icon_button("more", Icon::more, height, false, "More: role, rename, mirror, delete …"))
        ImGui::OpenPopup("menu");
    if (hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Right)) ImGui::OpenPopup("menu");
    if (ImGui::BeginPopup("menu")) {
        // The rows of the list stand close; those of a menu do not.
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, ui.scaled(8)});
        handle_menu(ui, handle);
        ImGui::PopStyleVar();
        ImGui::EndPopup();
    }
    if (ui.state.recoloring == handle.name) {
        ui.state.recoloring.clear();
        ImGui::OpenPopup("color");
    }
    ImGui::SetCursorScreenPos({corner.x, corner.y + height});
    ImGui::Dummy({width, ui.scaled(2)});
    ImGui::PopID();
}

// As high as it needs to be, or as the panels below it leave room for; then it scrolls by itself.
void handle_list(const Ui& ui, const std::vector<Handle>& handles) {
    UiState& state = ui.state;
    const float row = ImGui::GetFrameHeight() + ui.scaled(2);
    const float whole = row * static_cast<float>(handles.size());
    const float room = ImGui::GetWindowHeight() - state.beside_list;
    const float height = std::min(whole, std::max(row * fewest_rows, room));
    const float content = ImGui::GetCurrentWindow()->ContentSize.y; // of the last frame
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {ImGui::GetStyle().ItemSpacing.x, 0});
    if (ImGui::BeginChild("list", {0, height})) {
        // A handle is chosen before the document has it, and what was added in this frame can be scrolled to
        // in the next one.
        const bool is_measured = ImGui::GetScrollMaxY() + height > whole - 1;
        for (const std::size_t i : order_of_list(handles)) {
            handle_row(ui, handles[i], i);
            if (handles[i].name != ui.editor.chosen || state.listed_chosen == handles[i].name) continue;
            if (whole > height) ImGui::SetScrollHereY();
            if (is_measured) state.listed_chosen = handles[i].name;
        }
        if (ui.editor.chosen.empty()) state.listed_chosen.clear();
    }
    ImGui::EndChild();
    ImGui::PopStyleVar();
    state.beside_list =
        content - std::exchange(state.list_height, height) + 2 * ImGui::GetStyle().WindowPadding.y;
}

// What is done to the chosen handle, in one row; it is there without one, too, so that nothing below it
// jumps.
void chosen_buttons(const Ui& ui) {
    const Handle* handle = chosen_handle(ui.editor);
    const std::string name = handle ? handle->name : std::string();
    const float gap = ui.scaled(4);
    const float quarter = (ImGui::GetContentRegionAvail().x - 3 * gap) / 4;
    ImGui::BeginDisabled(!handle);
    if (ImGui::Button("Select", {quarter, 0})) ui.tell(SelectHandlePoints{name, SelectMode::replace});
    explain("Selects the points of the chosen handle (Shift+L)");
    ImGui::SameLine(0, gap);
    ImGui::BeginDisabled(!handle || handle->role != HandleRole::moving || !ui.editor.document->posed);
    if (ImGui::Button("Reset", {quarter, 0})) ui.tell(ResetPose{name});
    explain("Puts the chosen handle back where it was at rest, and unwinds its turns (Alt+R)");
    ImGui::EndDisabled();
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Mirror", {quarter, 0})) ImGui::OpenPopup("mirror");
    explain("Makes the same handle on the other side of the cloud, its pose mirrored");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Delete", {quarter, 0})) ui.tell(DeleteHandle{name});
    explain("Deletes the chosen handle; its points stay (Del)");
    ImGui::EndDisabled();
    if (!handle || !ImGui::BeginPopup("mirror")) return;
    mirror_items(ui, *handle);
    ImGui::EndPopup();
}

} // namespace

void handles_panel(const Ui& ui) {
    if (!ui.has_cloud()) {
        faint_text("Handles are the parts of a cloud that you hold. Open a cloud first.");
        return;
    }
    selection_buttons(ui);
    const std::vector<Handle>& handles = ui.editor.document->handles;
    if (handles.empty()) return;
    ImGui::Dummy({0, ui.scaled(2)});
    handle_list(ui, handles);
    chosen_buttons(ui);
    ImGui::BeginDisabled(!ui.editor.document->posed);
    if (key_button("Commit the pose", "Enter", true)) ui.tell(CommitPose{});
    explain("Makes the shape as it is now the new rest shape, from which the next edit starts");
    ImGui::EndDisabled();
}

} // namespace knead

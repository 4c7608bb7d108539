#include "app/handle_menu.h"

#include "app/number_fields.h"
#include "app/widgets.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace knead {

namespace {

constexpr double most_falloff = 10; // in diagonals of the cloud: what is typed beyond is a slip

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
            "What is as small or thin as this pulls at least so far: at a point or a line alone the surface "
            "would be drawn out to a spike");
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

} // namespace

void mirror_items(const Ui& ui, const Handle& handle) {
    if (ImGui::MenuItem("Along X")) ui.tell(MirrorHandle{handle.name, 0});
    if (ImGui::MenuItem("Along Y")) ui.tell(MirrorHandle{handle.name, 1});
    if (ImGui::MenuItem("Along Z")) ui.tell(MirrorHandle{handle.name, 2});
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
    const std::vector<std::string> together = chosen_with(ui.editor, handle.name);
    const std::vector<std::string> moved = moved_with(ui.editor, handle.name);
    if (ImGui::MenuItem(moved.size() == 1 ? "Reset its pose" : "Reset their poses", "Alt+Shift+R", false,
                        handle.role == HandleRole::moving && ui.editor.document->posed))
        ui.tell(ResetPoses{moved});
    if (ImGui::BeginMenu("Mirror")) {
        mirror_items(ui, handle);
        ImGui::EndMenu();
    }
    ImGui::Separator();
    const std::string words =
        together.size() == 1 ? "Delete" : "Delete all " + std::to_string(together.size());
    if (ImGui::MenuItem(words.c_str(), "Del")) ui.tell(DeleteHandles{together});
}

} // namespace knead

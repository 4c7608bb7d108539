// The panel "Handles": making handles of the selection, and the list of those there are.

#include "app/extents.h"
#include "app/handle_list.h"
#include "app/handle_menu.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <imgui_internal.h>

#include <array>
#include <optional>

namespace knead {

namespace {

void selection_words(const Ui& ui) {
    const std::size_t selected = ui.editor.selected;
    if (selected > 0) {
        faint_text(counted(selected, "point") +
                   (selected == 1 ? " selected. Make it a" : " selected. Make them a"));
        if (ImGui::IsItemHovered()) explain(shown_extent_text(ui));
    } else if (ui.editor.document->handles.empty())
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
    if (ImGui::Button("Reset", {quarter, 0})) ui.tell(ResetPoses{moved_with(ui.editor, name)});
    explain("Puts what is chosen back where it was at rest, with what goes along, and unwinds its turns "
            "(Alt+Shift+R; Alt+G, Alt+R and Alt+S take back the move, the turn or the scaling alone)");
    ImGui::EndDisabled();
    ImGui::SameLine(0, gap);
    const auto& symmetry = ui.editor.symmetry;
    if (ImGui::Button("Mirror", {quarter, 0})) {
        if (symmetry)
            ui.tell(MirrorHandle{name, symmetry->axis});
        else
            ImGui::OpenPopup("mirror");
    }
    explain("Makes the same handle on the other side of the cloud, its pose mirrored. While moves go on both "
            "sides that is across their plane, and the handle that is chosen stays chosen.");
    ImGui::SameLine(0, gap);
    if (ImGui::Button("Delete", {quarter, 0})) ui.tell(DeleteHandles{chosen_with(ui.editor, name)});
    explain("Deletes what is chosen; the points stay (Del)");
    ImGui::EndDisabled();
    if (!handle || !ImGui::BeginPopup("mirror")) return;
    mirror_items(ui, *handle);
    ImGui::EndPopup();
}

// Whether moves are made on the other side, too, and across which axis.
void symmetry_buttons(const Ui& ui) {
    const auto& symmetry = ui.editor.symmetry;
    inline_caption("Both sides", ui.scaled(92));
    const int clicked =
        segmented("symmetry", std::array{"Off", "X", "Y", "Z"}, symmetry ? symmetry->axis + 1 : 0);
    explain("What you move moves its counterpart on the other side of the cloud, too, mirrored across that "
            "axis: the handle that lies where the mirror shows the chosen one. Mirror makes one where there "
            "is none.");
    if (clicked < 0) return;
    ui.tell(MirrorMoves{clicked == 0 ? std::nullopt : std::optional(clicked - 1)});
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
    symmetry_buttons(ui);
    ImGui::BeginDisabled(!ui.editor.document->posed);
    if (key_button("Commit the pose", "Enter", true)) ui.tell(CommitPose{});
    explain("Makes the shape as it is now the new rest shape, from which the next edit starts");
    ImGui::EndDisabled();
}

} // namespace knead

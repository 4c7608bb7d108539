#include "app/label_dialog.h"

#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <algorithm>
#include <array>

namespace knead {

void choose_column(LabelDialog& dialog, std::size_t column) {
    dialog.column = column;
    dialog.roles.clear();
    if (column >= dialog.columns.size()) return;
    dialog.roles.assign(dialog.columns[column].values.size(), HandleRole::moving);
    dialog.roles[dialog.columns[column].commonest].reset();
}

namespace {

constexpr std::array<std::optional<HandleRole>, 4> choices{HandleRole::moving, HandleRole::fixed,
                                                           HandleRole::region_of_interest, std::nullopt};

void column_choice(LabelDialog& dialog) {
    caption("Attribute");
    ImGui::SetNextItemWidth(-1);
    if (!ImGui::BeginCombo("##column", dialog.columns[dialog.column].name.c_str())) return;
    for (std::size_t c = 0; c < dialog.columns.size(); ++c)
        if (ImGui::Selectable(dialog.columns[c].name.c_str(), c == dialog.column)) choose_column(dialog, c);
    ImGui::EndCombo();
}

// A row for each value: how many points have it, and what becomes of them.
void value_rows(const Ui& ui, LabelDialog& dialog, float height) {
    const LabelColumn& column = dialog.columns[dialog.column];
    ImGui::BeginChild("values", {0, height});
    for (std::size_t v = 0; v < column.values.size(); ++v) {
        ImGui::PushID(static_cast<int>(v));
        const auto role = std::ranges::find(choices, dialog.roles[v]);
        const float left = ImGui::GetCursorPosX();
        ImGui::AlignTextToFramePadding();
        ImGui::TextUnformatted(std::to_string(column.values[v].value).c_str());
        ImGui::SameLine(left + ui.scaled(62));
        caption(counted(column.values[v].points, "point").c_str());
        ImGui::SameLine(left + ui.scaled(190));
        const int clicked = segmented("role", std::array{"Moving", "Fixed", "Region", "None"},
                                      static_cast<int>(role - choices.begin()));
        if (clicked >= 0) dialog.roles[v] = choices[static_cast<std::size_t>(clicked)];
        ImGui::PopID();
    }
    ImGui::EndChild();
}

void make_handles(const Ui& ui, const LabelDialog& dialog) {
    const LabelColumn& column = dialog.columns[dialog.column];
    WishLabelHandles wish{column.name, {}};
    for (std::size_t v = 0; v < column.values.size(); ++v)
        if (dialog.roles[v]) wish.choices.push_back({column.values[v].value, *dialog.roles[v]});
    ui.wish(std::move(wish));
}

void buttons(const Ui& ui, const LabelDialog& dialog) {
    const auto count = std::ranges::count_if(dialog.roles, [](const auto& role) { return role.has_value(); });
    const float width = (ImGui::GetContentRegionAvail().x - ImGui::GetStyle().ItemSpacing.x) / 2;
    const bool escaped = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
    const bool entered = popup_has_keys() && ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    if (dialog.columns.empty()) {
        if (main_button("Close", {-1, 0}) || escaped || entered) ImGui::CloseCurrentPopup();
        return;
    }
    if (ImGui::Button("Cancel", {width, 0}) || escaped) ImGui::CloseCurrentPopup();
    ImGui::SameLine();
    ImGui::BeginDisabled(count == 0);
    const std::string label = "Make " + counted(static_cast<std::size_t>(count), "handle");
    if (main_button(label.c_str(), {width, 0}) || (entered && count > 0)) {
        make_handles(ui, dialog);
        ImGui::CloseCurrentPopup();
    }
    ImGui::EndDisabled();
}

} // namespace

void draw_label_dialog(const Ui& ui) {
    LabelDialog& dialog = ui.state.labels;
    if (dialog.open_now) ImGui::OpenPopup("labels");
    dialog.open_now = false;
    const ImGuiIO& io = ImGui::GetIO();
    ImGui::SetNextWindowPos({io.DisplaySize.x / 2, io.DisplaySize.y / 2}, ImGuiCond_Always, {0.5f, 0.5f});
    ImGui::SetNextWindowSize({std::min(ui.scaled(560), io.DisplaySize.x * 0.94f), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(24), ui.scaled(20)});
    const bool open = ImGui::BeginPopupModal(
        "labels", nullptr, ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoResize | ImGuiWindowFlags_NoMove);
    ImGui::PopStyleVar();
    if (!open) return;
    ImGui::PushFont(ui.state.fonts.title);
    ImGui::TextUnformatted("Handles from an attribute");
    ImGui::PopFont();
    if (dialog.columns.empty())
        faint_text(
            "This file has no attribute that labels its points: a column of whole numbers with no more "
            "than " +
            std::to_string(most_labels) + " different values.");
    else {
        faint_text("Each value becomes a handle of the points that have it.");
        column_choice(dialog);
        const auto rows = static_cast<float>(dialog.roles.size());
        const float row = ImGui::GetFrameHeightWithSpacing();
        value_rows(ui, dialog, std::min(rows * row, std::max(row, io.DisplaySize.y * 0.9f - 8 * row)));
    }
    ImGui::Dummy({0, ui.scaled(4)});
    buttons(ui, dialog);
    ImGui::EndPopup();
}

} // namespace knead

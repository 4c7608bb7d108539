#include "app/handle_list.h"

#include "app/handle_colors.h"
#include "app/handle_menu.h"
#include "app/icons.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <imgui_internal.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cstdio>
#include <utility>

namespace knead {

namespace {

constexpr float fewest_rows = 6;    // that can be seen at once
constexpr float end_of_swatch = 28; // from the left of a row

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
    const bool is_other = !escaped && !state.name_text.empty() && state.name_text != handle.name;
    if (is_other) ui.tell(RenameHandle{handle.name, state.name_text});
    const bool is_taken = is_other && handle_named(ui.editor.document->handles, state.name_text);
    if (entered && is_taken)
        state.renaming_begins = true; // what was typed is there to be changed
    else
        state.renaming.clear();
}

std::string points_of(const Editor& editor, const Handle& handle) {
    const std::size_t all = handle.points->size(), follow = followers_of(editor, handle);
    if (follow >= all || handle.role == HandleRole::region_of_interest) return counted(all, "point");
    return grouped(follow) + " of its " + counted(all, "point") + " (handles made later hold the others)";
}

std::string falloff_of(const Editor& editor, const Handle& handle) {
    const double falloff = std::max(handle.falloff, least_falloff(editor, handle));
    if (falloff <= 0 || handle.role == HandleRole::region_of_interest) return {};
    char words[64];
    std::snprintf(words, sizeof words, ", %spulls what is within %.3g", handle.falloff > 0 ? "soft: " : "",
                  falloff);
    return words;
}

// What a row of the list reacts to; returns whether the cursor is on it.
bool row_button(const Ui& ui, const Handle& handle, ImVec2 size, bool renaming) {
    if (renaming) {
        ImGui::Dummy(size);
        return false;
    }
    const bool chooses_more = ImGui::GetIO().KeyShift || ImGui::GetIO().KeyCtrl;
    const bool on_swatch =
        ImGui::GetIO().MousePos.x < ImGui::GetCursorScreenPos().x + ui.scaled(end_of_swatch);
    if (ImGui::InvisibleButton("row", size)) {
        if (on_swatch)
            ui.state.recoloring = handle.name;
        else if (chooses_more)
            ui.tell(ChooseAlso{handle.name});
        else
            ui.tell(ChooseHandle{handle.name});
    }
    const bool hovered = ImGui::IsItemHovered();
    if (hovered && !chooses_more && !on_swatch && ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) {
        ui.state.renaming = ui.state.name_text = handle.name;
        ui.state.renaming_begins = true;
    }
    if (hovered && ImGui::IsMouseClicked(ImGuiMouseButton_Left)) ui.state.row_at_rest = handle.name;
    if (!hovered && ui.state.row_at_rest == handle.name) ui.state.row_at_rest.clear();
    const bool quiet = ui.editor.tools.drag || ui.state.row_at_rest == handle.name; // it would be in the way
    if (hovered && !quiet && !ImGui::IsPopupOpen("menu"))
        explain(
            handle.name + ": " + words_for(handle.role) + ", " + points_of(ui.editor, handle) +
            (handle.free_rotation ? ", a peg: positions only" : "") + falloff_of(ui.editor, handle) +
            "\nClick chooses it, Shift+click lets it go along with the chosen one, a double click renames "
            "it, the right button has more; the square is its colour.");
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

// How the handle goes along with the chosen one, if it does.
enum class GoesAlong { no, same, mirrored };
GoesAlong goes_along(const Editor& editor, const std::string& handle) {
    const auto& also = editor.also_chosen;
    if (goes_mirrored(editor, handle)) return GoesAlong::mirrored;
    return std::ranges::find(also, handle) != also.end() ? GoesAlong::same : GoesAlong::no;
}

// In a word how it holds, where that is not the usual way; or while moves are mirrored, how it goes along.
const char* manner_of(const Editor& editor, const Handle& handle) {
    if (handle.role == HandleRole::region_of_interest) return "";
    if (goes_along(editor, handle.name) == GoesAlong::mirrored) return "mirrored";
    const bool is_chosen_alone = handle.name == editor.chosen && editor.also_chosen.empty();
    if (is_chosen_alone && handle.role == HandleRole::moving && editor.symmetry &&
        editor.symmetry->pairs.empty())
        return "alone";
    if (handle.free_rotation) return handle.falloff > 0 ? "soft peg" : "peg";
    return handle.falloff > 0 ? "soft" : "";
}

// What it is called, and at the end of the row how it holds.
void row_words(const Ui& ui, const Handle& handle, ImVec2 corner, float end) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float middle = corner.y + ImGui::GetFrameHeight() / 2, size = ui.state.fonts.small->FontSize;
    if (const char* manner = manner_of(ui.editor, handle); *manner != 0) {
        end -= ui.state.fonts.small->CalcTextSizeA(size, FLT_MAX, 0, manner).x;
        list.AddText(ui.state.fonts.small, size, {end, middle - size / 2}, palette::faint, manner);
        end -= ui.scaled(6);
    }
    const float top = middle - ImGui::GetFontSize() / 2;
    ImGui::RenderTextEllipsis(&list, {corner.x, top}, {end, corner.y + ImGui::GetFrameHeight()}, end, end,
                              handle.name.c_str(), nullptr, nullptr);
}

void handle_row(const Ui& ui, const Handle& handle, std::size_t number) {
    ImGui::PushID(static_cast<int>(number));
    const bool chosen = handle.name == ui.editor.chosen;
    const bool follows = goes_along(ui.editor, handle.name) != GoesAlong::no;
    const float height = ImGui::GetFrameHeight(), width = ImGui::GetContentRegionAvail().x;
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const bool renaming = ui.state.renaming == handle.name;
    const bool hovered = row_button(ui, handle, {width - height, height}, renaming);
    if (chosen || follows || hovered)
        list.AddRectFilled(corner, {corner.x + width, corner.y + height},
                           chosen || follows ? palette::field_pressed : palette::rgb(0xffffff, 14),
                           ui.scaled(5));
    if (chosen || follows)
        list.AddRectFilled(corner, {corner.x + ui.scaled(3), corner.y + height},
                           chosen ? palette::accent : palette::faint, ui.scaled(2));
    const float middle = corner.y + height / 2;
    color_swatch(ui, handle, {corner.x + ui.scaled(end_of_swatch - 10), middle});
    draw_icon(list, icon_of(handle.role), {corner.x + ui.scaled(40), middle}, ui.scaled(13), palette::text);
    const float text = ui.scaled(56);
    if (renaming) {
        ImGui::SetCursorScreenPos({corner.x + text - ImGui::GetStyle().FramePadding.x, corner.y});
        ImGui::SetNextItemWidth(width - text - height);
        name_field(ui, handle);
    } else {
        row_words(ui, handle, {corner.x + text, corner.y}, corner.x + width - height - ui.scaled(4));
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

} // namespace

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

} // namespace knead

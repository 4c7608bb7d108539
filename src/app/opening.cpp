// How far opening, or another long stage, is.

#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <algorithm>

namespace knead {

namespace {

void bar(const Ui& ui, double fraction) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float width = ImGui::GetContentRegionAvail().x, height = ui.scaled(6);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled(at, {at.x + width, at.y + height}, palette::field, height / 2);
    const float filled = width * static_cast<float>(std::clamp(fraction, 0.0, 1.0));
    if (filled >= height) list.AddRectFilled(at, {at.x + filled, at.y + height}, palette::accent, height / 2);
    ImGui::Dummy({width, height});
}

// At a part of the view's width and height; there its own same part lies.
void begin_card(const Ui& ui, const char* id, float width, ImVec2 part) {
    const Rectangle& view = ui.state.view;
    const ImVec2 place(view.x + view.width * part.x, view.y + view.height * part.y);
    ImGui::SetNextWindowPos(place, ImGuiCond_Always, part);
    ImGui::SetNextWindowSize({std::min(ui.scaled(width), view.width * 0.95f), 0});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.scaled(20), ui.scaled(16)});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.scaled(8));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::raised);
    ImGui::Begin(id, nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
}

void end_card() {
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(3);
}

std::string sentence(std::string words) {
    if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
        words[0] = static_cast<char>(words[0] - 'a' + 'A');
    return words;
}

} // namespace

void draw_opening(const Ui& ui) {
    ui.state.long_stage = {};
    if (ui.editor.opening) {
        const LiveDocument::Status status = ui.editor.opening->status();
        const OpenRequest& request = ui.editor.opening_request;
        begin_card(ui, "opening", 400, {0.5f, 0.5f});
        ImGui::TextUnformatted(
            ((request.restore ? "Restoring " : "Opening ") + request.file.filename().string()).c_str());
        bar(ui, status.fraction);
        faint_text(status.doing.empty() ? "Reading" : sentence(status.doing));
        ImGui::SameLine(ImGui::GetWindowWidth() - ui.scaled(110));
        if (ImGui::Button("Cancel", {ui.scaled(90), 0})) ui.wish(WishCancelOpening{});
        end_card();
        return;
    }
    if (!ui.editor.live) return;
    // Stages that a first drag or a change of samples starts: shown once they have taken a moment.
    const LiveDocument::Status status = ui.editor.live->status();
    UiState& state = ui.state;
    if (status.doing.empty()) {
        state.long_stage_since = ImGui::GetTime();
        return;
    }
    if (ImGui::GetTime() - state.long_stage_since < 0.25) return;
    begin_card(ui, "stage", 300, {0.5f, 0.97f});
    faint_text(sentence(status.doing));
    bar(ui, status.fraction);
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    state.long_stage = {at.x, at.y, size.x, size.y};
    end_card();
}

void draw_recovery(const Ui& ui) {
    ui.state.recovery_end = 0;
    if (ui.state.lost.empty() || ui.editor.opening) return;
    const LostWork work = ui.state.lost.front();
    // Out of the way of what is open.
    begin_card(ui, "recovery", ui.has_cloud() ? 390 : 480, {ui.has_cloud() ? 0.02f : 0.5f, 0.04f});
    const ImVec2 at = ImGui::GetCursorScreenPos();
    draw_icon(*ImGui::GetWindowDrawList(), Icon::warning, {at.x + ui.scaled(9), at.y + ui.scaled(9)},
              ui.scaled(18), palette::warning);
    ImGui::Indent(ui.scaled(30));
    ImGui::TextUnformatted("knead ended without saving");
    const bool is_saved = !work.session.empty(), is_whole = work.trouble.empty();
    if (!is_whole)
        faint_text("Its recording cannot be read: " + work.trouble + ". It lies there until you delete it.");
    else
        faint_text((work.steps == 1 ? "There is " : "There are ") + counted(work.steps, "recorded step") +
                   " on " + (is_saved ? work.session : work.cloud).filename().string() +
                   (is_saved ? " after it was saved last" : " that no session file has") +
                   ". Restoring brings back everything up to the last finished one.");
    ImGui::Unindent(ui.scaled(30));
    ImGui::Dummy({0, ui.scaled(2)});
    const float width = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
    const bool something_asks =
        ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId | ImGuiPopupFlags_AnyPopupLevel);
    const bool entered = is_whole && !ui.editor.document && !something_asks &&
                         ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Enter), false);
    ImGui::BeginDisabled(!is_whole);
    if (main_button("Restore", {width, 0}) || entered) ui.wish(WishRestore{work});
    ImGui::EndDisabled();
    ImGui::SameLine();
    if (ImGui::Button("Keep for later", {width, 0})) ui.state.lost.erase(ui.state.lost.begin());
    explain("Asks again at the next start");
    ImGui::SameLine();
    if (ImGui::Button("Delete…", {width, 0})) ui.state.deleting = work;
    ui.state.recovery_end = ImGui::GetWindowPos().y + ImGui::GetWindowSize().y;
    end_card();
}

} // namespace knead

// The line at the bottom: what to do next, and what the work costs.

#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <cstdio>
#include <utility>

namespace knead {

namespace {

std::string milliseconds(double seconds) {
    char text[32];
    std::snprintf(text, sizeof text, seconds < 0.00995 ? "%.1f ms" : "%.0f ms", seconds * 1000);
    return text;
}

// What the hand can do in the middle of a transform.
const char* transform_hint(const TransformDrag& drag) {
    switch (drag.kind) {
    case TransformKind::translate:
        return "X Y Z axis · Shift+X plane · type a length, Tab the next · Ctrl steps · Shift slow · Enter "
               "done · Esc as it was";
    case TransformKind::rotate:
        return "X Y Z axis · type degrees · Ctrl steps · Shift slow · Enter done · Esc as it was";
    default:
        return "X Y Z axis · type a factor, Tab the next · Ctrl steps · Shift slow · Enter done · Esc as it "
               "was";
    }
}

std::string left_words(const Ui& ui) {
    const Tools& tools = ui.editor.tools;
    if (tools.drag) return transform_hint(*tools.drag);
    if (tools.select == SelectTool::polygon && !tools.band.empty())
        return "Click corners · Enter or double click closes · Ctrl+Z takes one back · Esc gives up";
    const std::string playback = playback_words(ui);
    if (!playback.empty()) return playback;
    const std::string &done = ui.editor.just_done, next = next_step(ui.editor);
    return done + (done.empty() || next.empty() ? "" : " · ") + next;
}

// Of less and less account.
std::vector<std::string> facts(const Ui& ui) {
    const Measured& measured = ui.state.measured;
    std::vector<std::string> facts{counted(ui.editor.marks.size(), "point")};
    if (!measured.complete && measured.drawn < measured.in_view)
        facts.back() += " (" + grouped(measured.drawn) + " shown)";
    if (ui.editor.selected > 0) facts.push_back(grouped(ui.editor.selected) + " selected");
    if (ui.editor.hidden > 0) facts.push_back(grouped(ui.editor.hidden) + " hidden");
    if (ui.editor.document->samples > 0) facts.push_back(counted(ui.editor.document->samples, "sample"));
    if (measured.frame > 0) facts.push_back("frame " + milliseconds(measured.frame));
    if (measured.solve > 0) facts.push_back("solve " + milliseconds(measured.solve + measured.upsample));
    return facts;
}

// As many as fit.
std::string right_words(const Ui& ui, float room) {
    std::string words;
    for (const std::string& fact : facts(ui)) {
        std::string more = words;
        if (!more.empty()) more += "   ";
        more += fact;
        if (ImGui::CalcTextSize(more.c_str()).x > room) break;
        words = std::move(more);
    }
    return words;
}

} // namespace

void draw_status_line(const Ui& ui, Rectangle where) {
    ImGui::SetNextWindowPos({where.x, where.y});
    ImGui::SetNextWindowSize({where.width, where.height});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, 0.0f);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding,
                        {ui.scaled(14), (where.height - ui.state.fonts.small->FontSize) / 2});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowMinSize, {1.0f, 1.0f});
    ImGui::PushFont(ui.state.fonts.small);
    ImGui::Begin("status", nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav);
    if (ui.has_cloud()) {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const float end = where.x + where.width - ui.scaled(14);
        const std::string left = left_words(ui);
        const float room = end - at.x - ImGui::CalcTextSize(left.c_str()).x - ui.scaled(24);
        const std::string right = right_words(ui, room);
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.AddText(at, palette::text, left.c_str());
        list.AddText({end - ImGui::CalcTextSize(right.c_str()).x, at.y}, palette::faint, right.c_str());
    }
    ImGui::End();
    ImGui::PopFont();
    ImGui::PopStyleVar(3);
}

} // namespace knead

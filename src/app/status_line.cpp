// The line at the bottom: what to do next, and what the work costs.

#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <cstdio>

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
        return "X Y Z axis · Shift+X plane · type a length · Ctrl steps · Shift slow · Enter done · Esc as "
               "it was";
    case TransformKind::rotate:
        return "X Y Z axis · type degrees · Ctrl steps · Shift slow · Enter done · Esc as it was";
    default:
        return "X Y Z axis · type a factor · Ctrl steps · Shift slow · Enter done · Esc as it was";
    }
}

std::string left_words(const Ui& ui) {
    const Tools& tools = ui.editor.tools;
    if (tools.drag) return transform_hint(*tools.drag);
    if (tools.select == SelectTool::polygon && !tools.band.empty())
        return "Click corners · Enter or double click closes · Backspace takes one back · Esc gives up";
    const std::string playback = playback_words(ui);
    return playback.empty() ? next_step(ui.editor) : playback;
}

std::string right_words(const Ui& ui) {
    const Measured& measured = ui.state.measured;
    const std::size_t all = ui.editor.marks.size();
    std::string words = counted(all, "point");
    if (!measured.complete && measured.drawn < measured.in_view)
        words += " (" + grouped(measured.drawn) + " shown)";
    if (ui.editor.selected > 0) words += "   " + grouped(ui.editor.selected) + " selected";
    if (ui.editor.hidden > 0) words += "   " + grouped(ui.editor.hidden) + " hidden";
    if (ui.editor.document->samples > 0) words += "   " + counted(ui.editor.document->samples, "sample");
    if (measured.frame > 0) words += "   frame " + milliseconds(measured.frame);
    if (measured.solve > 0) words += "   solve " + milliseconds(measured.solve + measured.upsample);
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
        const std::string right = right_words(ui);
        const float width = ImGui::CalcTextSize(right.c_str()).x;
        const float start = where.x + where.width - width - ui.scaled(14);
        const ImVec2 at = ImGui::GetCursorScreenPos();
        ImDrawList& list = *ImGui::GetWindowDrawList();
        list.PushClipRect({where.x, where.y}, {start - ui.scaled(16), where.y + where.height}, true);
        list.AddText(at, palette::text, left_words(ui).c_str());
        list.PopClipRect();
        list.AddText({start, at.y}, palette::faint, right.c_str());
    }
    ImGui::End();
    ImGui::PopFont();
    ImGui::PopStyleVar(3);
}

} // namespace knead

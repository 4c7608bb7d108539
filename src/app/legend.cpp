// The scale of the colours, in the corner of the view.

#include "app/number_fields.h"
#include "app/overlay.h"
#include "app/widgets.h"

#include <algorithm>
#include <cstdio>

namespace knead {

namespace {

std::string number(double value, const std::string& format) {
    char text[48];
    std::snprintf(text, sizeof text, format.c_str(), value);
    return text;
}

ImU32 scale_color(double at) {
    const glm::vec3 color = viridis(at);
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1});
}

} // namespace

void draw_legend(const Ui& ui) {
    const Legend& legend = ui.state.legend;
    if (!ui.has_cloud() || !legend.range) return;
    const Rectangle& view = ui.state.view;
    const float width = ui.scaled(14), height = ui.scaled(170), margin = ui.scaled(14);
    ImDrawList& list = *ImGui::GetBackgroundDrawList();
    ImGui::PushFont(ui.state.fonts.small);
    const double low = legend.range->low, high = legend.range->high;
    const std::string format = format_between(low, high);
    constexpr int marks = 4; // between which the scale is written
    float text_width = ImGui::CalcTextSize(legend.title.c_str()).x - width;
    for (int i = 0; i <= marks; ++i)
        text_width = std::max(text_width,
                              ImGui::CalcTextSize(number(low + (high - low) * i / marks, format).c_str()).x);
    const float line = ImGui::GetTextLineHeight();
    const ImVec2 size(width + text_width + ui.scaled(8) + 2 * margin,
                      height + line + ui.scaled(10) + 2 * margin);
    // Below the card that offers to restore, where that is.
    const ImVec2 corner(view.x + ui.scaled(16), std::max(view.y, ui.state.recovery_end) + ui.scaled(16));
    ui.state.legend_place = {corner.x, corner.y, size.x, size.y};
    list.AddRectFilled(corner, {corner.x + size.x, corner.y + size.y}, palette::rgb(0x15171a, 170),
                       ui.scaled(7));
    list.AddText({corner.x + margin, corner.y + margin}, palette::text, legend.title.c_str());
    const float left = corner.x + margin, top = corner.y + margin + line + ui.scaled(10);
    constexpr int bands = 48;
    for (int i = 0; i < bands; ++i) {
        const double above = 1.0 - static_cast<double>(i) / bands,
                     below = 1.0 - static_cast<double>(i + 1) / bands;
        const float y0 = top + height * static_cast<float>(i) / bands,
                    y1 = top + height * static_cast<float>(i + 1) / bands;
        list.AddRectFilledMultiColor({left, y0}, {left + width, y1}, scale_color(above), scale_color(above),
                                     scale_color(below), scale_color(below));
    }
    for (int i = 0; i <= marks; ++i) {
        if (low == high && i != marks / 2) continue; // one value, one mark
        const float y = top + height * (1 - static_cast<float>(i) / marks);
        list.AddLine({left + width, y}, {left + width + ui.scaled(4), y}, palette::faint);
        list.AddText({left + width + ui.scaled(8), y - line / 2}, palette::text,
                     number(low + (high - low) * i / marks, format).c_str());
    }
    ImGui::PopFont();
}

} // namespace knead

#include "app/theme.h"

#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>
#include <string>

namespace knead {

ImU32 with_alpha(ImU32 color, float alpha) {
    const auto old = static_cast<float>(color >> IM_COL32_A_SHIFT);
    return (color & ~IM_COL32_A_MASK) | (static_cast<ImU32>(std::lround(old * alpha)) << IM_COL32_A_SHIFT);
}

ImVec4 as_vector(ImU32 color) {
    return ImGui::ColorConvertU32ToFloat4(color);
}

namespace {

// The letters of Europe, Greek for the names of settings, and the signs that knead's own words use.
const ImWchar glyphs[] = {0x0020, 0x017f, 0x0370, 0x03ff, 0x0400, 0x052f, 0x2010, 0x2027,
                          0x2030, 0x205e, 0x2070, 0x209f, 0x2190, 0x21ff, 0x2200, 0x22ff,
                          0x2300, 0x23ff, 0x25a0, 0x25ff, 0x2713, 0x2717, 0};

// The bold face stands beside the plain one.
std::string bold_font() {
    const std::filesystem::path plain(KNEAD_FONT);
    return (plain.parent_path() / (plain.stem().string() + "-Bold" + plain.extension().string())).string();
}

ImFont* load_font(const std::string& file, float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    ImFontConfig config;
    config.SizePixels = pixels;
    config.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored))
        if (ImFont* font = atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, glyphs)) return font;
    return atlas.AddFontDefault(&config);
}

void set_colors(ImGuiStyle& style) {
    const auto set = [&style](ImGuiCol which, ImU32 color) { style.Colors[which] = as_vector(color); };
    using namespace palette;
    set(ImGuiCol_Text, text);
    set(ImGuiCol_TextDisabled, faint);
    set(ImGuiCol_WindowBg,
        0); // the main loop clears the window's edges to the panels' colour, which is quicker
    set(ImGuiCol_ChildBg, 0);
    set(ImGuiCol_PopupBg, with_alpha(raised, 0.98f));
    set(ImGuiCol_Border, line);
    set(ImGuiCol_BorderShadow, 0);
    set(ImGuiCol_FrameBg, field);
    set(ImGuiCol_FrameBgHovered, field_hovered);
    set(ImGuiCol_FrameBgActive, field_pressed);
    set(ImGuiCol_TitleBg, raised);
    set(ImGuiCol_TitleBgActive, raised);
    set(ImGuiCol_TitleBgCollapsed, raised);
    set(ImGuiCol_MenuBarBg, 0);
    set(ImGuiCol_ScrollbarBg, 0);
    set(ImGuiCol_ScrollbarGrab, field);
    set(ImGuiCol_ScrollbarGrabHovered, field_hovered);
    set(ImGuiCol_ScrollbarGrabActive, field_pressed);
    set(ImGuiCol_CheckMark, accent);
    set(ImGuiCol_SliderGrab, accent);
    set(ImGuiCol_SliderGrabActive, accent_hovered);
    set(ImGuiCol_Button, field);
    set(ImGuiCol_ButtonHovered, field_hovered);
    set(ImGuiCol_ButtonActive, field_pressed);
    set(ImGuiCol_Header, field);
    set(ImGuiCol_HeaderHovered, field_hovered);
    set(ImGuiCol_HeaderActive, field_pressed);
    set(ImGuiCol_Separator, line);
    set(ImGuiCol_SeparatorHovered, accent);
    set(ImGuiCol_SeparatorActive, accent);
    set(ImGuiCol_ResizeGrip, 0);
    set(ImGuiCol_ResizeGripHovered, field_hovered);
    set(ImGuiCol_ResizeGripActive, field_pressed);
    set(ImGuiCol_PlotHistogram, accent);
    set(ImGuiCol_TextSelectedBg, with_alpha(accent, 0.35f));
    set(ImGuiCol_NavHighlight, with_alpha(accent, 0.8f));
    set(ImGuiCol_ModalWindowDimBg, rgb(0x0c0d0f, 150));
    set(ImGuiCol_TableHeaderBg, raised);
    set(ImGuiCol_TableBorderStrong, line);
    set(ImGuiCol_TableBorderLight, with_alpha(line, 0.5f));
    set(ImGuiCol_TableRowBgAlt, rgb(0xffffff, 6));
}

void set_distances(ImGuiStyle& style, float scale) {
    style.WindowPadding = {14, 12};
    style.FramePadding = {9, 5};
    style.ItemSpacing = {8, 8};
    style.ItemInnerSpacing = {8, 5};
    style.CellPadding = {6, 4};
    style.IndentSpacing = 18;
    style.ScrollbarSize = 11;
    style.GrabMinSize = 12;
    style.WindowRounding = 6;
    style.ChildRounding = 5;
    style.FrameRounding = 5;
    style.PopupRounding = 6;
    style.ScrollbarRounding = 6;
    style.GrabRounding = 4;
    style.TabRounding = 5;
    style.WindowBorderSize = 0;
    style.PopupBorderSize = 1;
    style.FrameBorderSize = 0;
    style.WindowTitleAlign = {0.0f, 0.5f};
    style.WindowMenuButtonPosition = ImGuiDir_None;
    style.DisabledAlpha = 0.42f;
    style.AntiAliasedLinesUseTex = false; // line widths between whole pixels
    style.CircleTessellationMaxError = 0.2f;
    style.ScaleAllSizes(scale);
    style.PopupBorderSize = 1;
}

} // namespace

Fonts apply_theme(float scale) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    Fonts fonts;
    fonts.text = load_font(KNEAD_FONT, std::round(16.0f * scale));
    fonts.small = load_font(KNEAD_FONT, std::round(14.0f * scale));
    fonts.title = load_font(KNEAD_FONT, std::round(25.0f * scale));
    fonts.bold = load_font(bold_font(), std::round(15.0f * scale));
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle{};
    set_colors(style);
    set_distances(style, scale);
    return fonts;
}

} // namespace knead

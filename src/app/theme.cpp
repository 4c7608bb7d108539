#include "app/theme.h"

#include "app/letters.h"

#include <imgui_freetype.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace knead {

ImU32 with_alpha(ImU32 color, float alpha) {
    const auto old = static_cast<float>(color >> IM_COL32_A_SHIFT);
    return (color & ~IM_COL32_A_MASK) | (static_cast<ImU32>(std::lround(old * alpha)) << IM_COL32_A_SHIFT);
}

ImVec4 as_vector(ImU32 color) {
    return ImGui::ColorConvertU32ToFloat4(color);
}

namespace {

// The bold face stands beside the plain one.
std::string bold_font() {
    const std::filesystem::path plain(KNEAD_FONT);
    return (plain.parent_path() / (plain.stem().string() + "-Bold" + plain.extension().string())).string();
}

ImFontConfig config_of(float pixels) {
    ImFontConfig config;
    config.SizePixels = pixels;
    config.FontBuilderFlags = ImGuiFreeTypeBuilderFlags_LightHinting;
    return config;
}

// Letters of other fonts beside those of the font that was added last. `ranges` are to stay until the atlas
// is built.
void merge(const LettersOfFont& other, const ImVector<ImWchar>& ranges, float pixels) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(other.file, ignored)) return;
    ImFontConfig config = config_of(pixels);
    config.MergeMode = true;
    config.FontNo = other.number;
    ImGui::GetIO().Fonts->AddFontFromFileTTF(other.file.c_str(), pixels, &config, ranges.Data);
}

ImFont* load_own_font(const std::string& file, float pixels) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    const ImFontConfig config = config_of(pixels);
    std::error_code ignored;
    if (std::filesystem::is_regular_file(file, ignored))
        if (ImFont* font = atlas.AddFontFromFileTTF(file.c_str(), pixels, &config, own_letters)) return font;
    return atlas.AddFontDefault(&config);
}

ImVector<ImWchar> ranges_of(const LettersOfFont& font) {
    ImFontGlyphRangesBuilder builder;
    for (const ImWchar letter : font.letters) builder.AddChar(letter);
    ImVector<ImWchar> ranges;
    builder.BuildRanges(&ranges);
    return ranges;
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

Fonts apply_theme(float scale, const std::set<ImWchar>& foreign_letters) {
    ImFontAtlas& atlas = *ImGui::GetIO().Fonts;
    atlas.Clear();
    atlas.FontBuilderIO = ImGuiFreeType::GetBuilderForFreeType();
    const std::vector<LettersOfFont> others = fonts_with(foreign_letters);
    std::vector<ImVector<ImWchar>> ranges;
    ranges.reserve(others.size());
    for (const LettersOfFont& other : others) ranges.push_back(ranges_of(other));
    const auto load = [&](const std::string& file, float size) {
        const float pixels = std::round(size * scale);
        ImFont* const font = load_own_font(file, pixels);
        for (std::size_t i = 0; i < others.size(); ++i) merge(others[i], ranges[i], pixels);
        return font;
    };
    Fonts fonts;
    fonts.text = load(KNEAD_FONT, 16);
    fonts.small = load(KNEAD_FONT, 14);
    fonts.title = load(KNEAD_FONT, 25);
    fonts.bold = load(bold_font(), 15);
    atlas.Build();
    ImGuiStyle& style = ImGui::GetStyle();
    style = ImGuiStyle{};
    set_colors(style);
    set_distances(style, scale);
    return fonts;
}

} // namespace knead

#include "app/widgets.h"

#include "app/theme.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace knead {

namespace {

// How long the cursor has to rest before an explanation comes, in seconds.
constexpr float patience = 0.4f;

// Of what stands in a panel at the right side beside that panel, at the lower edge above it: at the cursor it
// would hide what comes next; of what stands in a menu beside that. The farther right or down it is, the more
// of it is on the other side of there, so that none goes over the edge. Returns how wide it may be.
float place_explanation() {
    const ImVec2 panel = ImGui::GetWindowPos(), item = ImGui::GetItemRectMin(), cursor = ImGui::GetMousePos();
    const ImVec2 all = ImGui::GetIO().DisplaySize;
    constexpr float gap = 6;
    const bool beside = panel.x > all.x / 2;
    const ImGuiWindow& window = *ImGui::GetCurrentWindow();
    if (!beside && (window.Flags & ImGuiWindowFlags_Popup) && !(window.Flags & ImGuiWindowFlags_Modal)) {
        const float right = panel.x + window.Size.x + gap;
        ImGui::SetNextWindowPos({right, item.y}, ImGuiCond_Always);
        return all.x - right - gap;
    }
    if (beside)
        ImGui::SetNextWindowPos({panel.x - gap, item.y}, ImGuiCond_Always, {1, item.y / all.y});
    else if (panel.y > 0.8f * all.y)
        ImGui::SetNextWindowPos({cursor.x, panel.y - gap}, ImGuiCond_Always, {cursor.x / all.x, 1});
    return (beside ? panel.x : all.x) - 2 * gap;
}

constexpr float explanation_padding = 11; // at its sides

} // namespace

void explain(const char* words) {
    if (!ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled) || ImGui::IsAnyItemActive()) return;
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    if (context.HoveredId != 0 && context.HoveredIdTimer < patience) return;
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, ImVec2(explanation_padding, 8));
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, 1.0f);
    const float room = place_explanation() - 2 * explanation_padding;
    ImGui::BeginTooltip();
    wrapped_text(words, std::min(ImGui::GetFontSize() * 24, room));
    ImGui::EndTooltip();
    ImGui::PopStyleVar(2);
}

bool is_disabled() {
    return (ImGui::GetCurrentContext()->CurrentItemFlags & ImGuiItemFlags_Disabled) != 0;
}

namespace {

// Text on the accent's colour while it lives.
struct AccentColors {
    AccentColors() {
        ImGui::PushStyleColor(ImGuiCol_Button, palette::accent);
        ImGui::PushStyleColor(ImGuiCol_ButtonHovered, palette::accent_hovered);
        ImGui::PushStyleColor(ImGuiCol_ButtonActive, palette::accent);
        ImGui::PushStyleColor(ImGuiCol_Text, palette::on_accent);
    }
    ~AccentColors() { ImGui::PopStyleColor(4); }
    AccentColors(const AccentColors&) = delete;
    AccentColors& operator=(const AccentColors&) = delete;
};

} // namespace

bool main_button(const char* label, ImVec2 size) {
    if (is_disabled()) return ImGui::Button(label, size); // what cannot be pressed does not ask for it
    const AccentColors colors;
    return ImGui::Button(label, size);
}

bool key_button(const char* label, const char* keys, bool is_main) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight());
    ImGui::PushID(label);
    const bool accented = is_main && !is_disabled();
    const bool clicked = accented ? main_button("##button", size) : ImGui::Button("##button", size);
    ImGui::PopID();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const float alpha = ImGui::GetStyle().Alpha, padding = ImGui::GetStyle().FramePadding.x;
    const float down = (size.y - ImGui::GetFontSize()) / 2;
    const ImU32 ink = with_alpha(accented ? palette::on_accent : palette::text, alpha);
    list.AddText({corner.x + padding + 2, corner.y + down}, ink, label);
    const float width = ImGui::CalcTextSize(keys).x;
    list.AddText({corner.x + size.x - padding - 2 - width, corner.y + down}, with_alpha(ink, 0.6f), keys);
    return clicked;
}

bool section(const char* title, ImFont* font, bool unfold) {
    ImGuiStorage& storage = *ImGui::GetStateStorage();
    const ImGuiID id = ImGui::GetID(title);
    if (unfold) storage.SetBool(id, true);
    bool open = storage.GetBool(id, true);
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const ImVec2 size(ImGui::GetContentRegionAvail().x, ImGui::GetFrameHeight());
    if (ImGui::InvisibleButton(title, size)) storage.SetBool(id, open = !open);
    const ImU32 ink = ImGui::IsItemHovered() ? palette::accent_hovered : palette::text;
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddText(font, font->FontSize, {corner.x, corner.y + (size.y - font->FontSize) / 2}, ink, title);
    const float unit = font->FontSize / 15; // as the display is scaled
    const float middle = corner.y + size.y / 2, right = corner.x + size.x - 8 * unit, reach = 4 * unit;
    if (open) // a chevron downwards, or to the left
        for (const ImVec2 point :
             {ImVec2(right - reach, middle - reach / 2), ImVec2(right, middle + reach / 2),
              ImVec2(right + reach, middle - reach / 2)})
            list.PathLineTo(point);
    else
        for (const ImVec2 point :
             {ImVec2(right + reach / 2, middle - reach), ImVec2(right - reach / 2, middle),
              ImVec2(right + reach / 2, middle + reach)})
            list.PathLineTo(point);
    list.PathStroke(palette::faint, ImDrawFlags_None, 1.6f * unit);
    return open;
}

void close_popups() {
    if (ImGui::GetCurrentContext()->OpenPopupStack.Size > 0) ImGui::ClosePopupToLevel(0, false);
}

bool popup_has_keys() {
    const ImGuiContext& context = *ImGui::GetCurrentContext();
    return context.OpenPopupStack.Size == context.BeginPopupStack.Size;
}

void caption(const char* words) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette::faint);
    ImGui::TextUnformatted(words);
    ImGui::PopStyleColor();
}

void inline_caption(const char* words, float place) {
    ImGui::AlignTextToFramePadding();
    caption(words);
    ImGui::SameLine(place);
}

void wrapped_text(const std::string& words, float width) {
    std::string lines = words;
    std::size_t begin = 0, space = std::string::npos; // of the line, and the last one in it
    for (std::size_t at = 0; at <= lines.size(); ++at) {
        const bool ends = at == lines.size() || lines[at] == ' ' || lines[at] == '\n';
        if (!ends) continue;
        const bool fits = ImGui::CalcTextSize(lines.data() + begin, lines.data() + at).x <= width;
        if (!fits && space != std::string::npos) {
            lines[space] = '\n';
            begin = space + 1;
        }
        space = at;
        if (at < lines.size() && lines[at] == '\n') {
            begin = at + 1;
            space = std::string::npos;
        }
    }
    ImGui::PushTextWrapPos(ImGui::GetCursorPosX() + width);
    ImGui::TextUnformatted(lines.c_str());
    ImGui::PopTextWrapPos();
}

void wrapped_text(const std::string& words) {
    wrapped_text(words, ImGui::GetContentRegionAvail().x);
}

void faint_text(const std::string& words) {
    ImGui::PushStyleColor(ImGuiCol_Text, palette::faint);
    wrapped_text(words);
    ImGui::PopStyleColor();
}

int segmented(const char* id, std::span<const char* const> labels, int chosen) {
    ImGui::PushID(id);
    ImGui::BeginGroup(); // what explains it explains each
    const auto count = static_cast<float>(labels.size());
    const float gap = 2;
    const float width = (ImGui::GetContentRegionAvail().x - gap * (count - 1)) / count;
    int clicked = -1, number = 0;
    for (const char* label : labels) {
        if (number > 0) ImGui::SameLine(0, gap);
        const bool on = number == chosen;
        if (on ? main_button(label, {width, 0}) : ImGui::Button(label, {width, 0})) clicked = number;
        ++number;
    }
    ImGui::EndGroup();
    ImGui::PopID();
    return clicked;
}

float key_caps(ImDrawList* list, ImVec2 corner, const char* keys) {
    const ImFont& font = *ImGui::GetFont();
    const float size = ImGui::GetFontSize() * 0.88f;
    const float padding = size * 0.42f, height = size * 1.5f;
    float x = corner.x;
    std::string_view rest = keys;
    while (!rest.empty()) {
        // "Ctrl+Shift+S" are three caps; a plus at the end is itself a key.
        const std::size_t plus = rest.find('+', 1);
        const std::string_view cap = rest.substr(0, plus);
        rest = plus == std::string_view::npos ? std::string_view{} : rest.substr(plus + 1);
        const char* end = cap.data() + cap.size();
        const float text = font.CalcTextSizeA(size, 1e6f, 0, cap.data(), end).x;
        const float width = std::max(text + 2 * padding, height);
        if (list) {
            list->AddRectFilled({x, corner.y}, {x + width, corner.y + height}, palette::field, size * 0.3f);
            list->AddRect({x, corner.y}, {x + width, corner.y + height}, palette::rgb(0x4a505a), size * 0.3f);
            list->AddText(&font, size, {x + (width - text) / 2, corner.y + (height - size) / 2 - 0.5f},
                          palette::text, cap.data(), end);
        }
        x += width + size * 0.25f;
    }
    return x - corner.x;
}

std::string byte_size(std::uintmax_t bytes) {
    const char* units[] = {"B", "kB", "MB", "GB", "TB"};
    auto amount = static_cast<double>(bytes);
    std::size_t unit = 0;
    while (amount >= 999.5 && unit + 1 < std::size(units)) {
        amount /= 1000;
        ++unit;
    }
    char text[32];
    std::snprintf(text, sizeof text, unit == 0 || amount >= 99.5 ? "%.0f %s" : "%.1f %s", amount,
                  units[unit]);
    return text;
}

} // namespace knead

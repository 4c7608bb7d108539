#pragma once
// How the window looks: one palette, one font in three sizes, one set of distances.
//
// Distances are given for a display of scale 1 and multiplied by the monitor's content scale.

#include <imgui.h>

#include <array>
#include <set>

namespace knead {

namespace palette {
constexpr ImU32 rgb(unsigned hex, unsigned alpha = 255) {
    return IM_COL32((hex >> 16) & 0xff, (hex >> 8) & 0xff, hex & 0xff, alpha);
}
inline constexpr ImU32 window = rgb(0x1d1f23); // behind everything
inline constexpr ImU32 panel = rgb(0x24272c);
inline constexpr ImU32 raised = rgb(0x2b2f35); // cards, popups
inline constexpr ImU32 field = rgb(0x363b43);  // sliders, buttons
inline constexpr ImU32 field_hovered = rgb(0x424852);
inline constexpr ImU32 field_pressed = rgb(0x4d545f);
inline constexpr ImU32 line = rgb(0x3a3f47);
inline constexpr ImU32 text = rgb(0xdde0e5);
inline constexpr ImU32 faint = rgb(0x8f969f);  // second in rank
inline constexpr ImU32 accent = rgb(0xf59638); // the selection's orange
inline constexpr ImU32 accent_hovered = rgb(0xffa850);
inline constexpr ImU32 on_accent = rgb(0x1d1408); // text upon it
inline constexpr ImU32 warning = rgb(0xe8c35a);
inline constexpr ImU32 error = rgb(0xef6a61);
inline constexpr ImU32 good = rgb(0x7cc38b);
inline constexpr std::array axes{rgb(0xf2545b), rgb(0x7fc94d), rgb(0x4b93f7),
                                 rgb(0xe6e8ec)}; // x, y, z, screen
} // namespace palette

ImU32 with_alpha(ImU32 color, float alpha); // alpha times `alpha`
ImVec4 as_vector(ImU32 color);

struct Fonts {
    ImFont* text = nullptr;
    ImFont* small = nullptr;
    ImFont* bold = nullptr;
    ImFont* title = nullptr;
};

// Loads the fonts for this scale (DejaVu Sans, or the one built into ImGui where it is missing), with these
// letters of the system's other fonts beside its own (app/letters.h), and sets colours and distances. Call it
// between frames; fonts of earlier calls are gone.
Fonts apply_theme(float scale, const std::set<ImWchar>& foreign_letters = {});

} // namespace knead

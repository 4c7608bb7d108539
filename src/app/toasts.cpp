// Messages in a corner of the view, off what is being worked on. They stay long enough to be read, errors
// longer, and as long as the cursor is on them.

#include "app/overlay.h"
#include "app/ui.h"
#include "app/widgets.h"

#include <imgui_internal.h>

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t most = 6; // at a time; older ones make room

double reading_time(const Notice& notice) {
    const double by_length = 0.06 * static_cast<double>(notice.words.size()); // 16 letters a second
    switch (notice.kind) {
    case Notice::Kind::error:
        return 8 + by_length;
    case Notice::Kind::warning:
        return 6 + by_length;
    default:
        return 3 + by_length;
    }
}

ImU32 color_of(Notice::Kind kind) {
    switch (kind) {
    case Notice::Kind::error:
        return palette::error;
    case Notice::Kind::warning:
        return palette::warning;
    default:
        return palette::good;
    }
}

Icon icon_of(Notice::Kind kind) {
    switch (kind) {
    case Notice::Kind::error:
        return Icon::error;
    case Notice::Kind::warning:
        return Icon::warning;
    default:
        return Icon::information;
    }
}

float toast_width(const Ui& ui) {
    return std::min(ui.scaled(400), ui.state.view.width - ui.scaled(32));
}

// What the hand holds or reaches for next: the gizmo, and the band that is being drawn.
std::optional<ImRect> place_of_work(const Ui& ui) {
    const Editor& editor = ui.editor;
    std::optional<ImRect> place;
    const auto add = [&](ImVec2 middle, float reach) {
        const ImRect here(middle.x - reach, middle.y - reach, middle.x + reach, middle.y + reach);
        if (place)
            place->Add(here);
        else
            place = here;
    };
    const std::optional<Gizmo> gizmo = editor.document ? gizmo_of(editor) : std::nullopt;
    const auto seen = gizmo ? project(editor.camera, editor.viewport, gizmo->center) : std::nullopt;
    if (seen) add(in_window(ui, seen->pixel), 1.4f * static_cast<float>(gizmo->size) / ui.state.pixel_ratio);
    const std::vector<glm::dvec2>& band = editor.tools.band;
    for (const glm::dvec2 pixel : band) add(in_window(ui, pixel), ui.scaled(16));
    // Where it goes on: a click there is the next corner, and not for a message.
    if (!band.empty() && ImGui::IsMousePosValid()) add(ImGui::GetMousePos(), ui.scaled(16));
    return place;
}

// Keeps the messages off the place of work: where they lie over it they go to the other corner, if that is
// free. They stay there until they are gone, so that nothing jumps about.
void choose_corner(const Ui& ui) {
    UiState& state = ui.state;
    if (state.toasts.empty()) state.toasts_on_top = false;
    const std::optional<ImRect> work = place_of_work(ui);
    if (!work) return;
    const Rectangle& view = state.view;
    const float right = view.x + view.width - ui.scaled(16), left = right - toast_width(ui);
    const auto covers_work = [&](bool on_top) {
        const float edge = on_top ? view.y + ui.scaled(16) : view.y + view.height - ui.scaled(16);
        const float height = on_top ? state.toasts_height : -state.toasts_height;
        return work->Overlaps({left, std::min(edge, edge + height), right, std::max(edge, edge + height)});
    };
    if (covers_work(state.toasts_on_top) && !covers_work(!state.toasts_on_top))
        state.toasts_on_top = !state.toasts_on_top;
}

// Draws one with its right corner there, the upper or the lower one; returns its height and whether it was
// clicked away.
struct Drawn {
    float height = 0;
    bool clicked = false, hovered = false;
};
Drawn draw_toast(const Ui& ui, const Toast& toast, int number, ImVec2 corner) {
    const float width = toast_width(ui);
    const float inset = ui.scaled(44);
    ImGui::SetNextWindowPos(corner, ImGuiCond_Always, {1, ui.state.toasts_on_top ? 0.0f : 1.0f});
    ImGui::SetNextWindowSize({width, 0});
    ImGui::PushStyleVar(ImGuiStyleVar_Alpha, toast.shown);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, palette::raised);
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0f);
    const std::string id = "toast " + std::to_string(number);
    ImGui::Begin(id.c_str(), nullptr,
                 ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                     ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav);
    if (!ImGui::IsPopupOpen("", ImGuiPopupFlags_AnyPopupId)) // over the welcome card, too
        ImGui::BringWindowToDisplayFront(ImGui::GetCurrentWindow());
    const ImU32 color = with_alpha(color_of(toast.notice.kind), toast.shown);
    const ImVec2 at = ImGui::GetWindowPos(), size = ImGui::GetWindowSize();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.PushClipRectFullScreen();
    list.AddRectFilled({at.x, at.y}, {at.x + ui.scaled(4), at.y + size.y}, color, ui.scaled(4),
                       ImDrawFlags_RoundCornersLeft);
    list.PopClipRect();
    draw_icon(list, icon_of(toast.notice.kind), {at.x + ui.scaled(25), at.y + ui.scaled(22)}, ui.scaled(17),
              color);
    ImGui::SetCursorPosX(inset);
    wrapped_text(toast.notice.words, width - ui.scaled(34) - inset);
    Drawn drawn{.height = size.y};
    drawn.hovered = ImGui::IsWindowHovered();
    drawn.clicked = drawn.hovered && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
    draw_icon(list, Icon::close, {at.x + width - ui.scaled(18), at.y + ui.scaled(20)}, ui.scaled(11),
              with_alpha(drawn.hovered ? palette::text : palette::faint, toast.shown));
    ImGui::End();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor();
    return drawn;
}

} // namespace

void forget_shape(std::deque<Toast>& toasts) {
    std::erase_if(toasts, [](const Toast& toast) { return toast.notice.about != Notice::About::itself; });
}

void add_toast(UiState& state, Notice notice) {
    // The same again only begins its time anew.
    std::erase_if(state.toasts, [&](const Toast& old) {
        const bool is_outdated = notice.about != Notice::About::itself && old.notice.about == notice.about;
        return is_outdated || (old.notice.kind == notice.kind && old.notice.words == notice.words);
    });
    if (notice.words.empty()) return;
    const double seconds = reading_time(notice);
    state.toasts.push_back({std::move(notice), seconds, 0});
    while (state.toasts.size() > most) state.toasts.pop_front();
}

void draw_toasts(const Ui& ui) {
    choose_corner(ui);
    const Rectangle& view = ui.state.view;
    const bool on_top = ui.state.toasts_on_top;
    const float gap = ui.scaled(8);
    ImVec2 corner(view.x + view.width - ui.scaled(16),
                  on_top ? view.y + ui.scaled(16) : view.y + view.height - ui.scaled(16));
    // Above the card of a long stage, where both are not side by side.
    const Rectangle& card = ui.state.long_stage;
    if (!on_top && card.height > 0 && corner.x - toast_width(ui) < card.x + card.width)
        corner.y = std::min(corner.y, card.y - gap);
    const float step = std::min(ImGui::GetIO().DeltaTime, 0.1f);
    int number = 0;
    std::deque<Toast>& toasts = ui.state.toasts;
    ui.state.toasts_height = 0;
    for (auto toast = toasts.rbegin(); toast != toasts.rend(); ++toast) {
        toast->shown = std::min(1.0f, toast->shown + 6 * step);
        const Drawn drawn = draw_toast(ui, *toast, number++, corner);
        if (!drawn.hovered) toast->seconds_left -= static_cast<double>(ImGui::GetIO().DeltaTime);
        if (drawn.clicked) toast->seconds_left = 0;
        corner.y += on_top ? drawn.height + gap : -drawn.height - gap;
        ui.state.toasts_height += drawn.height + gap;
    }
    std::erase_if(toasts, [](const Toast& toast) { return toast.seconds_left <= 0; });
}

} // namespace knead

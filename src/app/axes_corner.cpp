#include "app/axes_corner.h"

#include "app/theme.h"
#include "app/widgets.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

constexpr float length = 30, ball = 8.5f; // scaled: of an axis, and the radius at its end

glm::dvec3 unit(int axis) {
    glm::dvec3 along(0.0);
    along[axis] = 1;
    return along;
}

struct Tip {
    ImVec2 end;
    double nearness; // to the eye, -1 … 1
    int axis;
};

ImVec2 middle_of(const Rectangle& place) {
    return {place.x + place.width / 2, place.y + place.height / 2};
}

// The farthest first.
std::array<Tip, 3> tips_of(const Ui& ui) {
    const ImVec2 middle = middle_of(axes_place(ui));
    const glm::dquat to_screen = glm::conjugate(ui.editor.camera.orientation);
    std::array<Tip, 3> tips{};
    for (int axis = 0; axis < 3; ++axis) {
        const glm::dvec3 along = to_screen * unit(axis);
        tips[static_cast<std::size_t>(axis)] = {{middle.x + ui.scaled(length) * static_cast<float>(along.x),
                                                 middle.y - ui.scaled(length) * static_cast<float>(along.y)},
                                                along.z,
                                                axis};
    }
    std::ranges::sort(tips, {}, &Tip::nearness);
    return tips;
}

} // namespace

Rectangle axes_place(const Ui& ui) {
    const Rectangle& view = ui.state.view;
    return {view.x + ui.scaled(10), view.y + view.height - ui.scaled(94), ui.scaled(84), ui.scaled(84)};
}

void draw_axes(const Ui& ui, ImDrawList& list) {
    if (!ui.state.display.axes) return;
    const bool may_click = ui.state.cursor_in_view && !ui.editor.tools.drag;
    const std::optional<int> lit = may_click ? axis_at(ui, ImGui::GetIO().MousePos) : std::nullopt;
    ImGui::PushFont(ui.state.fonts.small);
    for (const Tip& tip : tips_of(ui)) {
        const bool behind = tip.nearness < -0.3 && lit != tip.axis;
        const ImU32 color =
            with_alpha(palette::axes[static_cast<std::size_t>(tip.axis)], behind ? 0.5f : 0.95f);
        list.AddLine(middle_of(axes_place(ui)), tip.end, color, ui.scaled(2));
        list.AddCircleFilled(tip.end, ui.scaled(ball), color);
        if (lit == tip.axis) list.AddCircle(tip.end, ui.scaled(ball), palette::text, 0, ui.scaled(1.5f));
        const char letter[2] = {static_cast<char>('X' + tip.axis), 0};
        const ImVec2 size = ImGui::CalcTextSize(letter);
        list.AddText({tip.end.x - size.x / 2, tip.end.y - size.y / 2}, palette::rgb(0x14161a), letter);
    }
    ImGui::PopFont();
}

std::optional<int> axis_at(const Ui& ui, ImVec2 place) {
    std::optional<int> found; // the nearest to the eye
    if (!ui.state.display.axes || !ui.has_cloud()) return found;
    const float reach = ui.scaled(ball + 1.5f);
    for (const Tip& tip : tips_of(ui)) {
        const float x = place.x - tip.end.x, y = place.y - tip.end.y;
        if (x * x + y * y <= reach * reach) found = tip.axis;
    }
    return found;
}

Side side_of_axis(const Camera& camera, int axis) {
    const auto faces = [axis](const Camera& from) { // how much one looks against the axis
        return glm::dot(from.orientation * glm::dvec3(0, 0, 1), unit(axis));
    };
    const double wanted = faces(camera) > 0.999 ? -1 : 1;
    constexpr std::array sides = {Side::front, Side::back, Side::right, Side::left, Side::top, Side::bottom};
    return *std::ranges::max_element(sides, {}, [&](Side side) {
        Camera seen = camera;
        look_at_side(seen, side);
        return wanted * faces(seen);
    });
}

} // namespace knead

#include "app/icons.h"

#include "app/theme.h"
#include "app/widgets.h"

#include <array>
#include <cmath>
#include <initializer_list>
#include <numbers>
#include <vector>

namespace knead {

namespace {

// Icons are drawn in a square from -1 to 1, x to the right and y downwards.
struct Pen {
    ImDrawList& list;
    ImVec2 center;
    float unit;      // pixels
    float thickness; // of lines, pixels
    ImU32 color;

    ImVec2 at(ImVec2 point) const { return {center.x + unit * point.x, center.y + unit * point.y}; }

    void line(ImVec2 a, ImVec2 b) const { list.AddLine(at(a), at(b), color, thickness); }
    void path(std::initializer_list<ImVec2> points, bool closed = false) const {
        for (const ImVec2 point : points) list.PathLineTo(at(point));
        list.PathStroke(color, closed ? ImDrawFlags_Closed : ImDrawFlags_None, thickness);
    }
    void filled(std::initializer_list<ImVec2> points) const {
        for (const ImVec2 point : points) list.PathLineTo(at(point));
        list.PathFillConvex(color);
    }
    void circle(ImVec2 middle, float radius) const {
        list.AddCircle(at(middle), unit * radius, color, 0, thickness);
    }
    void dot(ImVec2 middle, float radius) const { list.AddCircleFilled(at(middle), unit * radius, color); }
    // Angles in eighths of a turn, clockwise from the right.
    void arc(ImVec2 middle, float radius, float from, float to) const {
        constexpr float eighth = std::numbers::pi_v<float> / 4;
        list.PathArcTo(at(middle), unit * radius, from * eighth, to * eighth);
        list.PathStroke(color, ImDrawFlags_None, thickness);
    }
    void rectangle(ImVec2 a, ImVec2 b, float rounding = 0) const {
        list.AddRect(at(a), at(b), color, unit * rounding, ImDrawFlags_None, thickness);
    }
    void dashed(ImVec2 a, ImVec2 b, int dashes) const {
        const float step = 1 / (2 * static_cast<float>(dashes) - 1);
        for (int i = 0; i < dashes; ++i) {
            const float from = 2 * static_cast<float>(i) * step;
            const auto between = [&](float t) {
                return ImVec2(a.x + t * (b.x - a.x), a.y + t * (b.y - a.y));
            };
            line(between(from), between(from + step));
        }
    }
    // An arrow's head at `tip`, pointing along (x, y) of length 1.
    void head(ImVec2 tip, ImVec2 along, float size) const {
        const ImVec2 across(-along.y, along.x);
        const ImVec2 back(tip.x - size * along.x, tip.y - size * along.y);
        filled({tip,
                {back.x + 0.7f * size * across.x, back.y + 0.7f * size * across.y},
                {back.x - 0.7f * size * across.x, back.y - 0.7f * size * across.y}});
    }
};

void draw_lasso(const Pen& pen) {
    ImDrawList& list = pen.list;
    list.PathLineTo(pen.at({-0.35f, 0.28f}));
    list.PathBezierCubicCurveTo(pen.at({-1.05f, 0.1f}), pen.at({-1.0f, -0.8f}), pen.at({0.05f, -0.8f}));
    list.PathBezierCubicCurveTo(pen.at({1.1f, -0.8f}), pen.at({1.05f, 0.3f}), pen.at({0.1f, 0.36f}));
    list.PathStroke(pen.color, ImDrawFlags_None, pen.thickness);
    pen.circle({-0.2f, 0.36f}, 0.2f);
    list.PathLineTo(pen.at({-0.3f, 0.54f}));
    list.PathBezierCubicCurveTo(pen.at({-0.4f, 0.85f}), pen.at({-0.1f, 0.85f}), pen.at({0.05f, 0.78f}));
    list.PathStroke(pen.color, ImDrawFlags_None, pen.thickness);
}

void draw_selecting(const Pen& pen, Icon icon) {
    switch (icon) {
    case Icon::click:
        pen.path({{-0.45f, -0.85f},
                  {-0.45f, 0.62f},
                  {-0.08f, 0.28f},
                  {0.17f, 0.85f},
                  {0.42f, 0.74f},
                  {0.18f, 0.19f},
                  {0.66f, 0.17f}},
                 true);
        break;
    case Icon::box:
        pen.dashed({-0.8f, -0.65f}, {0.8f, -0.65f}, 4);
        pen.dashed({0.8f, -0.65f}, {0.8f, 0.65f}, 3);
        pen.dashed({0.8f, 0.65f}, {-0.8f, 0.65f}, 4);
        pen.dashed({-0.8f, 0.65f}, {-0.8f, -0.65f}, 3);
        break;
    case Icon::lasso:
        draw_lasso(pen);
        break;
    case Icon::polygon:
        pen.path({{-0.72f, 0.5f}, {-0.45f, -0.55f}, {0.35f, -0.75f}, {0.75f, 0.05f}, {0.2f, 0.7f}}, true);
        for (const ImVec2 corner : {ImVec2(-0.72f, 0.5f), ImVec2(-0.45f, -0.55f), ImVec2(0.35f, -0.75f),
                                    ImVec2(0.75f, 0.05f), ImVec2(0.2f, 0.7f)})
            pen.dot(corner, 0.17f);
        break;
    case Icon::brush:
        pen.circle({-0.15f, 0.15f}, 0.62f);
        pen.dot({-0.15f, 0.15f}, 0.14f);
        pen.line({0.38f, -0.38f}, {0.85f, -0.85f});
        break;
    default: // through: two sheets and an arrow that goes through both
        pen.rectangle({-0.8f, -0.55f}, {0.25f, 0.8f}, 0.12f);
        pen.dashed({-0.25f, -0.82f}, {0.75f, -0.82f}, 3);
        pen.dashed({0.75f, -0.82f}, {0.75f, 0.45f}, 3);
        pen.line({-0.35f, 0.25f}, {0.3f, -0.2f});
        pen.head({0.5f, -0.34f}, {0.82f, -0.57f}, 0.34f);
        break;
    }
}

void draw_transform(const Pen& pen, Icon icon) {
    switch (icon) {
    case Icon::move:
        pen.line({0, -0.6f}, {0, 0.6f});
        pen.line({-0.6f, 0}, {0.6f, 0});
        pen.head({0, -0.95f}, {0, -1}, 0.38f);
        pen.head({0, 0.95f}, {0, 1}, 0.38f);
        pen.head({-0.95f, 0}, {-1, 0}, 0.38f);
        pen.head({0.95f, 0}, {1, 0}, 0.38f);
        break;
    case Icon::rotate:
        pen.arc({0, 0.05f}, 0.72f, -0.9f, 5.4f);
        pen.head({0.28f, -0.88f}, {-0.94f, -0.3f}, 0.46f);
        break;
    case Icon::scale:
        pen.rectangle({-0.8f, 0.05f}, {-0.05f, 0.8f}, 0.08f);
        pen.line({0.12f, -0.12f}, {0.6f, -0.6f});
        pen.head({0.85f, -0.85f}, {0.707f, -0.707f}, 0.42f);
        break;
    case Icon::pivot:
        pen.circle({0, 0}, 0.5f);
        pen.dot({0, 0}, 0.13f);
        for (const ImVec2 along : {ImVec2(1, 0), ImVec2(-1, 0), ImVec2(0, 1), ImVec2(0, -1)})
            pen.line({0.5f * along.x, 0.5f * along.y}, {0.9f * along.x, 0.9f * along.y});
        break;
    case Icon::local:
        pen.line({-0.35f, 0.45f}, {-0.75f, -0.7f});
        pen.line({-0.35f, 0.45f}, {0.8f, 0.05f});
        pen.dot({-0.35f, 0.45f}, 0.17f);
        pen.head({-0.8f, -0.85f}, {-0.33f, -0.94f}, 0.32f);
        pen.head({0.95f, 0}, {0.94f, -0.33f}, 0.32f);
        break;
    default: // world: a globe
        pen.circle({0, 0}, 0.8f);
        pen.line({-0.8f, 0}, {0.8f, 0});
        pen.list.AddBezierCubic(pen.at({0, -0.8f}), pen.at({0.55f, -0.4f}), pen.at({0.55f, 0.4f}),
                                pen.at({0, 0.8f}), pen.color, pen.thickness);
        pen.list.AddBezierCubic(pen.at({0, -0.8f}), pen.at({-0.55f, -0.4f}), pen.at({-0.55f, 0.4f}),
                                pen.at({0, 0.8f}), pen.color, pen.thickness);
        break;
    }
}

void draw_role(const Pen& pen, Icon icon) {
    switch (icon) {
    case Icon::moving:
        draw_transform(pen, Icon::move);
        break;
    case Icon::fixed: // a padlock
        pen.list.AddRectFilled(pen.at({-0.62f, -0.1f}), pen.at({0.62f, 0.85f}), pen.color, 0.18f * pen.unit);
        pen.list.PathLineTo(pen.at({-0.4f, -0.05f}));
        pen.list.PathArcTo(pen.at({0, -0.42f}), 0.4f * pen.unit, std::numbers::pi_v<float>,
                           2 * std::numbers::pi_v<float>);
        pen.list.PathLineTo(pen.at({0.4f, -0.05f}));
        pen.list.PathStroke(pen.color, ImDrawFlags_None, pen.thickness);
        break;
    default: // region: four corners
        for (const float x : {-1.0f, 1.0f})
            for (const float y : {-1.0f, 1.0f})
                pen.path({{0.78f * x, 0.28f * y}, {0.78f * x, 0.78f * y}, {0.28f * x, 0.78f * y}});
        pen.dot({0, 0}, 0.2f);
        break;
    }
}

void draw_file(const Pen& pen, Icon icon) {
    switch (icon) {
    case Icon::folder:
        pen.path({{-0.85f, 0.65f},
                  {-0.85f, -0.6f},
                  {-0.25f, -0.6f},
                  {-0.02f, -0.35f},
                  {0.85f, -0.35f},
                  {0.85f, 0.65f}},
                 true);
        break;
    case Icon::cloud: // points
        for (const ImVec2 point :
             {ImVec2(0, -0.7f), ImVec2(-0.5f, -0.35f), ImVec2(0.52f, -0.4f), ImVec2(0.02f, -0.05f),
              ImVec2(-0.72f, 0.25f), ImVec2(0.7f, 0.22f), ImVec2(-0.3f, 0.6f), ImVec2(0.35f, 0.62f)})
            pen.dot(point, 0.15f);
        break;
    case Icon::session:
        pen.path({{-0.6f, -0.85f}, {0.25f, -0.85f}, {0.65f, -0.4f}, {0.65f, 0.85f}, {-0.6f, 0.85f}}, true);
        pen.line({-0.28f, -0.05f}, {0.33f, -0.05f});
        pen.line({-0.28f, 0.4f}, {0.33f, 0.4f});
        break;
    case Icon::picture: // mountains under the sun, in a frame
        pen.path({{-0.85f, -0.65f}, {0.85f, -0.65f}, {0.85f, 0.65f}, {-0.85f, 0.65f}}, true);
        pen.path({{-0.85f, 0.45f}, {-0.3f, -0.1f}, {0.1f, 0.3f}, {0.35f, 0.05f}, {0.85f, 0.5f}});
        pen.dot({0.4f, -0.28f}, 0.14f);
        break;
    case Icon::up:
        pen.line({0, 0.75f}, {0, -0.5f});
        pen.path({{-0.5f, -0.2f}, {0, -0.72f}, {0.5f, -0.2f}});
        break;
    default: // home
        pen.path({{-0.85f, 0}, {0, -0.75f}, {0.85f, 0}});
        pen.path({{-0.58f, -0.05f}, {-0.58f, 0.75f}, {0.58f, 0.75f}, {0.58f, -0.05f}});
        break;
    }
}

void draw_sign(const Pen& pen, Icon icon) {
    switch (icon) {
    case Icon::information:
        pen.circle({0, 0}, 0.85f);
        pen.dot({0, -0.38f}, 0.14f);
        pen.line({0, -0.05f}, {0, 0.5f});
        break;
    case Icon::warning:
        pen.path({{0, -0.8f}, {0.9f, 0.75f}, {-0.9f, 0.75f}}, true);
        pen.line({0, -0.25f}, {0, 0.22f});
        pen.dot({0, 0.5f}, 0.12f);
        break;
    case Icon::error:
        pen.circle({0, 0}, 0.85f);
        pen.line({0, -0.45f}, {0, 0.12f});
        pen.dot({0, 0.45f}, 0.14f);
        break;
    case Icon::close:
        pen.line({-0.55f, -0.55f}, {0.55f, 0.55f});
        pen.line({0.55f, -0.55f}, {-0.55f, 0.55f});
        break;
    case Icon::plus:
        pen.line({-0.7f, 0}, {0.7f, 0});
        pen.line({0, -0.7f}, {0, 0.7f});
        break;
    default: // more
        for (const float y : {-0.6f, 0.0f, 0.6f}) pen.dot({0, y}, 0.17f);
        break;
    }
}

void draw_player(const Pen& pen, Icon icon) {
    switch (icon) {
    case Icon::play:
        pen.filled({{-0.5f, -0.75f}, {0.8f, 0}, {-0.5f, 0.75f}});
        break;
    case Icon::pause:
        pen.list.AddRectFilled(pen.at({-0.6f, -0.7f}), pen.at({-0.15f, 0.7f}), pen.color);
        pen.list.AddRectFilled(pen.at({0.15f, -0.7f}), pen.at({0.6f, 0.7f}), pen.color);
        break;
    case Icon::first:
        pen.filled({{0.65f, -0.65f}, {0.65f, 0.65f}, {-0.4f, 0}});
        pen.line({-0.6f, -0.65f}, {-0.6f, 0.65f});
        break;
    case Icon::frame_back:
        pen.filled({{0.1f, -0.5f}, {0.1f, 0.5f}, {-0.65f, 0}});
        pen.line({0.5f, -0.5f}, {0.5f, 0.5f});
        break;
    case Icon::frame_on:
        pen.filled({{-0.1f, -0.5f}, {0.65f, 0}, {-0.1f, 0.5f}});
        pen.line({-0.5f, -0.5f}, {-0.5f, 0.5f});
        break;
    default: // last
        pen.filled({{-0.65f, -0.65f}, {0.4f, 0}, {-0.65f, 0.65f}});
        pen.line({0.6f, -0.65f}, {0.6f, 0.65f});
        break;
    }
}

} // namespace

void draw_icon(ImDrawList& list, Icon icon, ImVec2 center, float size, ImU32 color) {
    const Pen pen{list, center, size / 2, std::max(1.2f, size / 12), color};
    if (icon <= Icon::through)
        draw_selecting(pen, icon);
    else if (icon <= Icon::world)
        draw_transform(pen, icon);
    else if (icon <= Icon::region)
        draw_role(pen, icon);
    else if (icon <= Icon::home)
        draw_file(pen, icon);
    else if (icon <= Icon::plus)
        draw_sign(pen, icon);
    else
        draw_player(pen, icon);
}

bool icon_button(const char* id, Icon icon, float side, bool on, const char* tooltip) {
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    const bool clicked = ImGui::InvisibleButton(id, {side, side});
    const bool hovered = ImGui::IsItemHovered();
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const ImVec2 opposite(corner.x + side, corner.y + side);
    const float alpha = ImGui::GetStyle().Alpha;
    const ImU32 back = on                      ? palette::accent
                       : ImGui::IsItemActive() ? palette::field_pressed
                                               : palette::field_hovered;
    if (on || hovered)
        list.AddRectFilled(corner, opposite, with_alpha(back, alpha), ImGui::GetStyle().FrameRounding);
    const ImU32 ink = on ? palette::on_accent : hovered ? palette::text : palette::rgb(0xb9bfc8);
    draw_icon(list, icon, {corner.x + side / 2, corner.y + side / 2}, std::round(side * 0.54f),
              with_alpha(ink, alpha));
    if (tooltip && *tooltip) explain(tooltip);
    return clicked;
}

} // namespace knead

#include "app/display.h"

#include "edit/editor.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace knead {

void resize_points_by(Display& display, float factor) {
    PointLook& look = display.look;
    if (look.size_by_distance)
        look.scale = std::clamp(look.scale * factor, smallest_scale, largest_scale);
    else
        look.pixels = std::clamp(look.pixels * factor, smallest_point, largest_point);
}

const char* name_of(Coloring coloring) {
    switch (coloring) {
    case Coloring::file:
        return "File colours";
    case Coloring::plain:
        return "Plain";
    case Coloring::height:
        return "Height";
    case Coloring::normal:
        return "Normals";
    case Coloring::attribute:
        return "Attribute";
    case Coloring::displacement:
        return "Displacement";
    case Coloring::stretch:
        return "Local stretch";
    default:
        return "Connected parts";
    }
}

bool tells_number(Coloring coloring) {
    return coloring == Coloring::height || coloring == Coloring::attribute ||
           coloring == Coloring::displacement || coloring == Coloring::stretch;
}

bool follows_pose(Coloring coloring) {
    return coloring == Coloring::height || coloring == Coloring::normal ||
           coloring == Coloring::displacement || coloring == Coloring::stretch;
}

namespace {

// The largest part is plain. The others' hues go round by the golden angle: parts next to each other in
// number, which lie near each other, differ.
std::vector<std::uint32_t> colors_of_parts(const Components& parts) {
    const glm::vec3 plain = ColorBy().plain;
    std::vector<std::uint32_t> colors;
    colors.reserve(parts.size.size());
    for (std::size_t part = 0; part < parts.size.size(); ++part) {
        const double turns = 0.6180339887 * static_cast<double>(part + 1);
        colors.push_back(ImColor::HSV(static_cast<float>(turns - std::floor(turns)), 0.62f, 0.92f));
    }
    if (const auto largest = std::ranges::max_element(parts.size); largest != parts.size.end())
        colors[static_cast<std::size_t>(largest - parts.size.begin())] = ImColor(plain.r, plain.g, plain.b);
    return colors;
}

// False while they are not known.
bool color_parts(const Editor& editor, std::vector<std::uint32_t>& colors) {
    if (!editor.document->components) return false;
    const Components& parts = *editor.document->components;
    const std::vector<std::uint32_t> of_part = colors_of_parts(parts);
    const Numbering& vertex = editor.opened.order->vertex;
    for (std::size_t i = 0; i < vertex.size(); ++i) colors[i] = of_part[parts.component[vertex[i]]];
    return true;
}

ColorBy::Kind kind_of(Coloring coloring) {
    switch (coloring) {
    case Coloring::file:
        return ColorBy::Kind::own;
    case Coloring::height:
        return ColorBy::Kind::height;
    case Coloring::normal:
        return ColorBy::Kind::normal;
    case Coloring::attribute:
        return ColorBy::Kind::attribute;
    default:
        return ColorBy::Kind::plain;
    }
}

// From zero, so that what did not move is at the foot of the scale, to what 99 % of the points that moved are
// within: a stray that went much farther than all others would leave these one colour. Of very many points
// some tell: it is done again whenever they move.
ValueRange range_of_displacements(const std::vector<float>& values, const Editor& editor) {
    constexpr std::size_t enough = 1 << 16;
    std::vector<float> moved;
    for (std::size_t i = 0; i < values.size(); i += values.size() / enough + 1)
        if (values[i] > 0) moved.push_back(values[i]);
    // So small a part may have moved that none of it was met.
    double high = values.empty() ? 0 : static_cast<double>(std::ranges::max(values));
    if (!moved.empty()) {
        const auto last = moved.begin() + static_cast<std::ptrdiff_t>((99 * moved.size() + 99) / 100 - 1);
        std::ranges::nth_element(moved, last);
        high = static_cast<double>(*last);
    }
    if (!(high > 0)) high = editor.opened.bounds.diagonal() / 100;
    return {0, high > 0 ? high : 1};
}

} // namespace

Legend color_points(const Display& display, Editor& editor, std::vector<std::uint32_t>& colors) {
    ColorBy by;
    by.kind = kind_of(display.coloring);
    by.attribute = display.attribute;
    by.up = editor.camera.up;
    if (tells_number(display.coloring) && !display.automatic_range) by.range = display.range;
    std::vector<float> values;
    if (display.coloring == Coloring::displacement) {
        values = displacements(editor);
        by.title = "Displacement";
        if (display.automatic_range) by.range = range_of_displacements(values, editor);
    } else if (display.coloring == Coloring::stretch) {
        values = local_stretch(editor);
        by.title = "Local stretch";
    }
    const std::vector<Index>& file_index = editor.opened.order->file_index;
    if (values.size() == file_index.size()) by.kind = ColorBy::Kind::values;
    colors.resize(file_index.size());
    if (display.coloring == Coloring::parts && color_parts(editor, colors)) return {};
    const PointsToColor points{editor.opened.cloud, file_index, editor.frame.positions(),
                               editor.frame.normals(), values};
    return color_points(by, points, colors, editor.workers);
}

} // namespace knead

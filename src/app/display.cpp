#include "app/display.h"

#include "edit/editor.h"

#include <algorithm>

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

std::vector<float> part_numbers(const Editor& editor) {
    std::vector<float> numbers;
    if (!editor.document->components) return numbers;
    const Numbering& vertex = editor.opened.order->vertex;
    numbers.resize(vertex.size());
    for (std::size_t i = 0; i < vertex.size(); ++i) {
        // Spread over the scale, so that parts next to each other in number differ in colour.
        const auto number = static_cast<double>(editor.document->components->component[vertex[i]]);
        const double spread = number * 0.6180339887;
        numbers[i] = static_cast<float>(spread - static_cast<double>(static_cast<long>(spread)));
    }
    return numbers;
}

ColorBy::Kind kind_of(Coloring coloring) {
    switch (coloring) {
    case Coloring::file:
        return ColorBy::Kind::rgb;
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
        // From zero, so that what did not move is at the foot of the scale.
        const double largest = values.empty() ? 0 : static_cast<double>(std::ranges::max(values));
        const double high = largest > 0 ? largest : editor.opened.bounds.diagonal() / 100;
        if (display.automatic_range) by.range = ValueRange{0, high > 0 ? high : 1};
    } else if (display.coloring == Coloring::stretch) {
        values = local_stretch(editor);
        by.title = "Local stretch";
    } else if (display.coloring == Coloring::parts) {
        values = part_numbers(editor);
        by.range = ValueRange{0, 1};
    }
    const std::vector<Index>& file_index = editor.opened.order->file_index;
    if (values.size() == file_index.size()) by.kind = ColorBy::Kind::values;
    colors.resize(file_index.size());
    const PointsToColor points{editor.opened.cloud, file_index, editor.frame.positions, editor.frame.normals,
                               values};
    Legend legend = color_points(by, points, colors, editor.workers);
    if (display.coloring == Coloring::parts) legend = {};
    return legend;
}

} // namespace knead

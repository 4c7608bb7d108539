#include "app/extents.h"

#include "edit/view_vectors.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>

namespace knead {

namespace {

// The least that is told apart.
double unit_of(const Ui& ui) {
    return std::max(ui.editor.opened.bounds.diagonal(), DBL_MIN) / 1e4;
}

} // namespace

std::string length_format(const Ui& ui, double value) {
    constexpr int room = 7; // for digits
    const double unit = unit_of(ui);
    const int wanted = std::max(0, static_cast<int>(std::ceil(-std::log10(unit))));
    const int before = std::max(1, static_cast<int>(std::floor(std::log10(std::abs(value) + 1e-9))) + 1);
    if (wanted >= room || before > room + 1) return "%.3g";
    return "%." + std::to_string(std::clamp(room - before, 0, wanted)) + "f";
}

std::string extent_text(const Ui& ui, const Bounds& bounds) {
    const Vec3d size = bounds.highest - bounds.lowest, middle = (bounds.lowest + bounds.highest) / 2;
    std::string words = "Size: ";
    const auto add = [&](double length, const char* behind) {
        if (std::abs(length) < 0.5 * unit_of(ui)) length = 0; // no "-0.0"
        char number[48];
        std::snprintf(number, sizeof number, length_format(ui, length).c_str(), length);
        words.append(number).append(behind);
    };
    for (int axis = 0; axis < 3; ++axis) add(size[axis], axis < 2 ? " × " : "\nMiddle: ");
    for (int axis = 0; axis < 3; ++axis) add(middle[axis], axis < 2 ? ", " : "");
    return words;
}

std::string shown_extent_text(const Ui& ui) {
    const Editor& editor = ui.editor;
    ShownExtent& known = ui.state.shown_extent;
    // Very many points take a while to be looked at, and as long as they move they come anew with every
    // picture.
    const bool moves = editor.drag || editor.status.solving || editor.status.playing;
    const bool is_other = known.frame_version == 0 || known.marks_version != editor.marks_version ||
                          (known.frame_version != editor.frame.version && !moves);
    if (is_other)
        known = {editor.marks_version, editor.frame.version,
                 box_of_selection(editor).value_or(box_of(editor))};
    const Vec3d& origin = editor.opened.cloud->origin;
    return extent_text(ui, {origin + to_eigen(known.box.lowest), origin + to_eigen(known.box.highest)});
}

} // namespace knead

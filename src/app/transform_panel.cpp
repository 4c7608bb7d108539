// The panel "Transform": the pose of the chosen handle as numbers, to be read, slid and typed.

#include "app/number_fields.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "edit/pose_numbers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace knead {

namespace {

constexpr double least_factor = 0.001; // what is slid to; 0 would flatten

struct RowLook {
    PoseRow row;
    const char* name;
    const char* unit; // of its format
    const char* words;
};
constexpr RowLook row_looks[] = {
    {PoseRow::place, "Place", "", "Where its pivot is now, in the file's coordinates"},
    {PoseRow::moved, "Moved", "", "How far its pivot went in this edit, in the file's units"},
    {PoseRow::turned, "Turned", "°",
     "How far it turned in this edit, about the world's X, then Y, then Z; whole turns count"},
    {PoseRow::scaled, "Scaled", "", "How many times as long as at rest it is along each of its own axes"},
};

double diagonal_of(const Editor& editor) {
    return (editor.opened.bounds.highest - editor.opened.bounds.lowest).norm();
}

// Of lengths: a ten-thousandth of the cloud is told apart.
int decimals_of(const Ui& ui, PoseRow row) {
    if (row == PoseRow::turned) return 1;
    if (row == PoseRow::scaled) return 3;
    const double unit = std::max(diagonal_of(ui.editor), 1e-12) / 1e4;
    return std::clamp(static_cast<int>(std::ceil(-std::log10(unit))), 0, 9);
}

// For each pixel that the hand goes.
double speed_of(const Ui& ui, PoseRow row) {
    if (row == PoseRow::turned) return 0.5;
    if (row == PoseRow::scaled) return 0.005;
    return diagonal_of(ui.editor) / 1000;
}

double number_in(const PoseNumbers& numbers, PoseRow row, int axis) {
    switch (row) {
    case PoseRow::place:
        return numbers.place[axis];
    case PoseRow::moved:
        return numbers.moved[axis];
    case PoseRow::turned:
        return numbers.turned[axis];
    default:
        return numbers.scaled[axis];
    }
}

// Of the row "Place", which shows the file's coordinates.
double origin_of(const Ui& ui, PoseRow row, int axis) {
    return row == PoseRow::place ? ui.editor.opened.cloud->origin[axis] : 0;
}

Vec3d pivot_of(const ChosenPose& pose) {
    return {pose.pivot.x, pose.pivot.y, pose.pivot.z};
}

void begin(const Ui& ui, const ChosenPose& pose) {
    ui.state.pose_fields.base = pose;
    ui.tell(BeginDrag{pose.pivot});
}

// From where it was when the hand began.
void go_to(const Ui& ui, PoseRow row, int axis, double value) {
    const ChosenPose& base = *ui.state.pose_fields.base;
    if (row == PoseRow::scaled) value = std::max(value, least_factor);
    ui.tell(DragTo{transform_to(base.motion, pivot_of(base), row, axis, value - origin_of(ui, row, axis))});
}

void end(const Ui& ui, bool keep) {
    ui.state.pose_fields.base.reset();
    if (keep)
        ui.tell(EndDrag{});
    else
        ui.tell(CancelDrag{});
}

void type(const Ui& ui, const ChosenPose& pose, PoseRow row, int axis, double value) {
    if (row == PoseRow::scaled && value < least_factor)
        return add_toast(ui.state,
                         {Notice::Kind::information,
                          "A handle is neither mirrored nor flattened by a factor: it is above 0."});
    begin(ui, pose);
    go_to(ui, row, axis, value);
    end(ui, true);
}

void pose_field(const Ui& ui, const ChosenPose& pose, const RowLook& look, int axis) {
    PoseFields& fields = ui.state.pose_fields;
    const int decimals = decimals_of(ui, look.row);
    char format[24];
    std::snprintf(format, sizeof format, "%%.%df%s", decimals, look.unit);
    double value =
        number_in(numbers_of(pose.motion, pivot_of(pose)), look.row, axis) + origin_of(ui, look.row, axis);
    if (std::abs(value) < 0.5 * std::pow(10.0, -decimals)) value = 0; // no "-0.0"
    const char id[] = {'#', '#', "xyz"[axis], 0};
    switch (number_field(id, value, speed_of(ui, look.row), format, fields.editing)) {
    case NumberEdit::none:
        break;
    case NumberEdit::slides:
        if (!fields.base) begin(ui, pose);
        go_to(ui, look.row, axis, value);
        break;
    case NumberEdit::slid:
        if (fields.base) end(ui, true);
        break;
    case NumberEdit::typed:
        type(ui, pose, look.row, axis, value);
        break;
    case NumberEdit::given_up:
        if (fields.base) end(ui, false);
        break;
    }
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled(
        low, {low.x + ui.scaled(3), high.y},
        with_alpha(palette::axes[static_cast<std::size_t>(axis)], ImGui::GetStyle().Alpha), ui.scaled(2));
    char words[160];
    std::snprintf(words, sizeof words, "%c: %.*f%s. %s. Slide it, or click and type; Tab goes on.",
                  "XYZ"[axis], decimals, value, look.unit, look.words);
    explain(words);
}

void pose_rows(const Ui& ui, const ChosenPose& pose) {
    const float gap = ui.scaled(3), left = ui.scaled(62);
    const std::optional<Gizmo> gizmo = gizmo_of(ui.editor);
    for (const RowLook& look : row_looks) {
        ImGui::PushID(look.name);
        inline_caption(look.name, left);
        const bool has_effect = !gizmo || (look.row == PoseRow::turned   ? gizmo->rotate
                                           : look.row == PoseRow::scaled ? gizmo->scale
                                                                         : true);
        ImGui::BeginDisabled(!has_effect);
        const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0) ImGui::SameLine(0, gap);
            ImGui::SetNextItemWidth(width);
            pose_field(ui, pose, look, axis);
        }
        ImGui::EndDisabled();
        ImGui::PopID();
    }
}

// What is open, where no handle is chosen.
void cloud_words(const Ui& ui) {
    const Bounds& bounds = ui.editor.opened.bounds;
    const Vec3d size = bounds.highest - bounds.lowest, middle = (bounds.lowest + bounds.highest) / 2;
    const int decimals = std::max(0, decimals_of(ui, PoseRow::place) - 1);
    char words[240];
    std::snprintf(words, sizeof words, "The cloud: %.*f × %.*f × %.*f\nIts middle: %.*f, %.*f, %.*f",
                  decimals, size.x(), decimals, size.y(), decimals, size.z(), decimals, middle.x(), decimals,
                  middle.y(), decimals, middle.z());
    faint_text(words);
    explain("As it was opened, in the file's units");
}

} // namespace

void transform_panel(const Ui& ui) {
    PoseFields& fields = ui.state.pose_fields;
    if (!ui.has_cloud()) {
        faint_text("Where a handle is, how far it turned, and how large it became.");
        return;
    }
    if (fields.handle != ui.editor.chosen) fields = {};
    fields.handle = ui.editor.chosen;
    const std::optional<ChosenPose> pose = pose_of_chosen(ui.editor);
    if (pose) return pose_rows(ui, *pose);
    fields = {};
    faint_text("Choose a moving handle to read and type its pose.");
    cloud_words(ui);
}

} // namespace knead

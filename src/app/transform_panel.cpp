// The panel "Transform": the pose of the chosen handle as numbers, to be read, slid and typed.

#include "app/extents.h"
#include "app/number_fields.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "edit/pose_numbers.h"
#include "edit/view_vectors.h"

#include <imgui_internal.h>

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace knead {

namespace {

struct RowLook {
    PoseRow row;
    const char* name;
    const char* unit; // of its format
    const char* words;
};
constexpr RowLook row_looks[] = {
    {PoseRow::place, "Place", "",
     "Where its pivot is now, in the file's coordinates. Another number moves the handle "
     "there; in pivot mode (.) the pivot alone"},
    {PoseRow::moved, "Moved", "", "How far its pivot went in this edit, in the file's units"},
    {PoseRow::turned, "Turned", "°",
     "How far it turned in this edit, about the world's X, then Y, then Z; whole turns count"},
    {PoseRow::scaled, "Scaled", "", "How many times as long as at rest it is along each of its own axes"},
};

std::string format_of(const Ui& ui, PoseRow row, double value) {
    if (row == PoseRow::turned) return "%.1f°";
    if (row == PoseRow::scaled) return "%.3f";
    return length_format(ui, value);
}

// For each pixel that the hand goes.
double speed_of(const Ui& ui, PoseRow row) {
    if (row == PoseRow::turned) return 0.5;
    if (row == PoseRow::scaled) return 0.005;
    return ui.editor.opened.bounds.diagonal() / 1000;
}

// Of the row "Place", which shows the file's coordinates.
double origin_of(const Ui& ui, PoseRow row, int axis) {
    return row == PoseRow::place ? ui.editor.opened.cloud->origin[axis] : 0;
}

// Of one field.
struct Field {
    PoseRow row;
    int axis;
};

// In pivot mode the place is the pivot's alone, as it is for the gizmo's arrows.
bool moves_pivot(const Ui& ui, Field field) {
    return field.row == PoseRow::place && ui.editor.tools.move_pivot;
}

// From where the handle, or its pivot, was when the hand began.
Transform transform_for(const Ui& ui, const ChosenPose& base, Field field, double value) {
    return transform_to(base.motion, to_eigen(base.pivot), field.row, field.axis,
                        value - origin_of(ui, field.row, field.axis));
}

// The angles that were typed or slid tell a turn about x from one about z where the pose does not: where y is
// a right angle.
void keep_angles(const Ui& ui, const ChosenPose& base, Field field, double value) {
    if (field.row != PoseRow::turned) return;
    Vec3d& turned = ui.state.pose_fields.turned;
    turned = base.motion.turned;
    turned[field.axis] = value * std::numbers::pi / 180;
}

void slide(const Ui& ui, const ChosenPose& pose, Field field, double value) {
    PoseFields& fields = ui.state.pose_fields;
    if (!fields.base) {
        fields.base = pose;
        fields.slides_pivot = moves_pivot(ui, field);
        if (!fields.slides_pivot) ui.tell(BeginDrag{pose.pivot});
    }
    fields.slid = transform_for(ui, *fields.base, field, value);
    keep_angles(ui, *fields.base, field, value);
    if (fields.slides_pivot)
        ui.tell(SetPivot{transformed(fields.slid, fields.base->pivot), SetPivot::Stage::moving});
    else
        ui.tell(DragTo{fields.slid});
}

void end_slide(const Ui& ui, bool keep) {
    PoseFields& fields = ui.state.pose_fields;
    if (!fields.base) return;
    keep = keep && !does_nothing(fields.slid);
    if (fields.slides_pivot)
        ui.tell(keep ? SetPivot{transformed(fields.slid, fields.base->pivot)}
                     : SetPivot{{}, SetPivot::Stage::given_up});
    else if (keep)
        ui.tell(EndDrag{});
    else
        ui.tell(CancelDrag{});
    fields.base.reset();
}

void refuse(const Ui& ui, const char* format, double number) {
    char words[96];
    std::snprintf(words, sizeof words, format, number);
    add_toast(ui.state, {Notice::Kind::information, words});
}

void type(const Ui& ui, const ChosenPose& pose, Field field, double value) {
    if (field.row == PoseRow::scaled && value < least_factor)
        return refuse(ui, "A handle is scaled by %g at least.", least_factor);
    const Transform transform = transform_for(ui, pose, field, value);
    if (!(std::abs(transform.angle) <= most_turned)) // nor by what is no number
        return refuse(ui, "At once a handle turns by %.0f° at most.", most_turned * 180 / std::numbers::pi);
    if (does_nothing(transform)) return;
    if (moves_pivot(ui, field)) return ui.tell(SetPivot{transformed(transform, pose.pivot)});
    keep_angles(ui, pose, field, value);
    ui.tell(BeginDrag{pose.pivot});
    ui.tell(DragTo{transform});
    ui.tell(EndDrag{});
}

// What a field shows, and how it is used.
std::string words_about(const Ui& ui, const RowLook& look, Field field, double value, bool is_sheared) {
    char number[48];
    std::snprintf(number, sizeof number, "%c: %.7g%s. ", "XYZ"[field.axis], value, look.unit);
    std::string words = number;
    words += moves_pivot(ui, field) ? "Where its pivot is: moves that alone, as the gizmo's arrows do now"
                                    : look.words;
    if (look.row == PoseRow::scaled && is_sheared)
        words +=
            ". It was stretched along other axes than its own, too: Reset and Alt+S take all of that back";
    return words + (is_disabled() ? "." : ". Slide it, or click and type; Tab goes on.");
}

void pose_field(const Ui& ui, const ChosenPose& pose, const PoseNumbers& numbers, const RowLook& look,
                int axis) {
    PoseFields& fields = ui.state.pose_fields;
    double value = number_in(numbers, look.row, axis) + origin_of(ui, look.row, axis);
    const std::string format = format_of(ui, look.row, value);
    if (std::abs(value) < 1e-9 * ui.editor.opened.bounds.diagonal()) value = 0; // no "-0.0"
    const char id[] = {'#', '#', "xyz"[axis], 0};
    const Field field{look.row, axis};
    const double lowest = look.row == PoseRow::scaled ? least_factor : -FLT_MAX;
    const NumberEdit edit =
        number_field(id, value, speed_of(ui, look.row), format.c_str(), fields.editing, lowest);
    if (edit == NumberEdit::slides) slide(ui, pose, field, value);
    if (edit == NumberEdit::slid) end_slide(ui, true);
    if (edit == NumberEdit::given_up) end_slide(ui, false);
    if (edit == NumberEdit::typed) type(ui, pose, field, value);
    if (fields.editing.types && fields.editing.field == ImGui::GetID(id)) {
        fields.typed_row = look.row;
        fields.typed_axis = axis;
    }
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    ImGui::GetWindowDrawList()->AddRectFilled(
        low, {low.x + ui.scaled(3), high.y},
        with_alpha(palette::axes[static_cast<std::size_t>(axis)], ImGui::GetStyle().Alpha), ui.scaled(2));
    explain(words_about(ui, look, field, value, numbers.is_sheared));
}

bool has_effect(const Ui& ui, PoseRow row) {
    const std::optional<Gizmo> gizmo = gizmo_of(ui.editor);
    if (row == PoseRow::turned) return has_effect(*gizmo, TransformKind::rotate);
    if (row == PoseRow::scaled) return has_effect(*gizmo, TransformKind::scale);
    return true;
}

void pose_rows(const Ui& ui, const ChosenPose& pose) {
    const PoseNumbers numbers = numbers_of(pose.motion, to_eigen(pose.pivot));
    const float gap = ui.scaled(3), left = ui.scaled(66);
    const bool waits = poses_may_change(ui.editor);
    ImGui::PushID(ui.editor.chosen.c_str()); // what is typed for one is not for another
    for (const RowLook& look : row_looks) {
        ImGui::PushID(look.name);
        inline_caption(look.name, left);
        // What the document is yet to do would make what is typed meanwhile another pose.
        ImGui::BeginDisabled(!has_effect(ui, look.row) || waits);
        const float width = (ImGui::GetContentRegionAvail().x - 2 * gap) / 3;
        for (int axis = 0; axis < 3; ++axis) {
            if (axis > 0) ImGui::SameLine(0, gap);
            ImGui::SetNextItemWidth(width);
            pose_field(ui, pose, numbers, look, axis);
        }
        ImGui::EndDisabled();
        ImGui::PopID();
    }
    ImGui::PopID();
}

// Where no handle is chosen: how large what is selected is, or else the cloud.
void extent_words(const Ui& ui) {
    faint_text(shown_extent_text(ui));
    explain(ui.editor.selected > 0 ? "Of the selected points as they are now, in the file's units"
                                   : "Of the cloud as it is now, in the file's units");
}

} // namespace

void transform_panel(const Ui& ui) {
    if (!ui.has_cloud()) {
        faint_text("Where a handle is, how far it turned, and how large it became.");
        return;
    }
    PoseFields& fields = ui.state.pose_fields;
    std::optional<ChosenPose> pose = pose_of_chosen(ui.editor);
    if (fields.handle != ui.editor.chosen || !pose) {
        end_slide(ui, true);
        fields = {};
        fields.handle = ui.editor.chosen;
    }
    if (pose && are_one_turn(fields.turned, pose->motion.turned)) pose->motion.turned = fields.turned;
    if (pose) return pose_rows(ui, *pose);
    // As high as the rows of a pose, or all below would jump when a handle is chosen.
    const float end = ImGui::GetCursorPosY() +
                      static_cast<float>(std::size(row_looks)) * ImGui::GetFrameHeightWithSpacing();
    faint_text("Choose a moving handle to read and type its pose.");
    extent_words(ui);
    const float left = end - ImGui::GetCursorPosY() - ImGui::GetStyle().ItemSpacing.y;
    if (left > 0) ImGui::Dummy({0, left});
}

} // namespace knead

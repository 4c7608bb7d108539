// The panel "Display": what colours the points, how large they are, and what is shown beside them.

#include "app/number_fields.h"
#include "app/scene_lines.h"
#include "app/ui.h"
#include "app/widgets.h"
#include "base/counts.h"

#include <algorithm>
#include <array>

namespace knead {

namespace {

void choose(const Ui& ui, Coloring coloring, const std::string& attribute = {}) {
    Display& display = ui.state.display;
    display.coloring = coloring;
    display.attribute = attribute;
    display.automatic_range = true;
}

// Nothing: this cloud has none.
const char* name_of(OwnColors own) {
    return own == OwnColors::rgb         ? name_of(Coloring::file)
           : own == OwnColors::intensity ? "Intensity in grey"
                                         : nullptr;
}

std::string chosen_name(const Ui& ui) {
    const Display& display = ui.state.display;
    if (display.coloring == Coloring::attribute) return display.attribute;
    if (display.coloring != Coloring::file) return name_of(display.coloring);
    const char* const own = name_of(own_colors(*ui.editor.opened.cloud));
    return own != nullptr ? own : name_of(Coloring::plain);
}

// What this cloud can be coloured by: item(name, is it chosen) lays one out, and returns whether it was
// taken.
void coloring_items(const Ui& ui, bool (*item)(const char* name, bool chosen)) {
    const Display& display = ui.state.display;
    const PointCloud& cloud = *ui.editor.opened.cloud;
    for (const Coloring coloring : {Coloring::file, Coloring::plain, Coloring::height, Coloring::normal,
                                    Coloring::displacement, Coloring::stretch, Coloring::parts}) {
        const char* const name = coloring == Coloring::file ? name_of(own_colors(cloud)) : name_of(coloring);
        if (name == nullptr) continue;
        if (coloring == Coloring::normal && ui.editor.frame.normals().empty()) continue;
        if (item(name, chosen_name(ui) == name)) choose(ui, coloring);
    }
    const std::vector<std::string> columns = scalar_columns(cloud);
    if (columns.empty()) return;
    ImGui::Separator();
    caption("Attributes of the file");
    for (const std::string& column : columns) {
        const bool chosen = display.coloring == Coloring::attribute && display.attribute == column;
        if (item(column.c_str(), chosen)) choose(ui, Coloring::attribute, column);
    }
}

void coloring_choice(const Ui& ui) {
    inline_caption("Colour by", ui.scaled(92));
    if (!ImGui::BeginCombo("##coloring", chosen_name(ui).c_str(), ImGuiComboFlags_HeightLarge)) return;
    coloring_items(ui, [](const char* name, bool chosen) { return ImGui::Selectable(name, chosen); });
    ImGui::EndCombo();
}

void range_fields(const Ui& ui) {
    Display& display = ui.state.display;
    if (!tells_number(display.coloring)) return;
    bool automatic = display.automatic_range;
    if (ImGui::Checkbox("Range by itself", &automatic)) {
        display.automatic_range = automatic;
        if (!automatic && ui.state.legend.range) display.range = *ui.state.legend.range;
    }
    explain("The scale goes from the 1st to the 99th percentile of the values");
    if (automatic) return;
    const auto [low, high] = display.range;
    const double step = std::max(1e-9, 0.005 * (high - low));
    const std::string format = format_between(low, high);
    const float gap = 2, width = (ImGui::GetContentRegionAvail().x - gap) / 2;
    const auto field = [&](const char* id, double& end) {
        ImGui::SetNextItemWidth(width);
        const NumberEdit edit = number_field(id, end, step, format.c_str(), ui.state.range_fields);
        explain("The lowest and the highest value of the scale; slide it, or click and type");
        return edit == NumberEdit::slides || edit == NumberEdit::typed;
    };
    // The one that is moved goes no farther than the other.
    if (field("##lowest", display.range.low)) display.range.low = std::min(display.range.low, high);
    ImGui::SameLine(0, gap);
    if (field("##highest", display.range.high)) display.range.high = std::max(display.range.high, low);
}

void size_slider(const Ui& ui) {
    PointLook& look = ui.state.display.look;
    if (look.size_by_distance) {
        bar_slider("Point size", look.scale, smallest_scale, largest_scale, "× %.2f",
                   ImGuiSliderFlags_Logarithmic);
        explain("1: points just touch, so that the surface looks closed (+ and -)");
    } else {
        bar_slider("Point size", look.pixels, smallest_point, largest_point, "%.1f px",
                   ImGuiSliderFlags_Logarithmic);
        explain("The diameter on the screen, in pixels (+ and -)");
    }
}

// The next item goes to the right of the last one.
void second_column() {
    ImGui::SameLine(ImGui::GetWindowContentRegionMin().x + ImGui::GetWindowContentRegionWidth() * 0.5f);
}

// What the solver works on. There is nothing to see before it has been asked for anything.
void sample_overlays(const Ui& ui) {
    Display& display = ui.state.display;
    const auto& samples = ui.editor.document->sample_vertices;
    const bool too_many = samples && samples->size() > most_shown_samples;
    const std::string trouble =
        !samples   ? "\nThey are chosen once there is a handle to move."
        : too_many ? "\nNot shown: there are more than " + grouped(most_shown_samples) + " of them."
                   : "";
    ImGui::BeginDisabled(!trouble.empty());
    ImGui::Checkbox("Samples", &display.samples);
    explain("The points that are solved for; all others follow those near them" + trouble);
    second_column();
    ImGui::Checkbox("Sample links", &display.sample_graph);
    explain("Which samples hold each other" + trouble);
    ImGui::EndDisabled();
}

void overlays(const Ui& ui) {
    Display& display = ui.state.display;
    ImGui::Checkbox("By distance", &display.look.size_by_distance);
    explain(
        "Points are as large as they lie apart in the cloud, so far ones are smaller; otherwise all have one "
        "size on the screen");
    second_column();
    ImGui::Checkbox("Eye-dome", &display.look.eye_dome);
    explain("Eye-dome lighting: darkens what lies behind, so that depth shows without normals (E)");
    ImGui::Checkbox("Shading", &display.look.shading);
    explain(ui.editor.frame.normals().empty()
                ? "Lights the points. This file has no normals: they are estimated, for looking at only"
                : "Lights the points by their normals");
    second_column();
    ImGui::Checkbox("Ground grid", &display.grid);
    ImGui::Checkbox("Handles", &display.handles);
    explain(
        "The colours and patterns of what handles hold; without them a saved picture shows the cloud alone");
    second_column();
    ImGui::Checkbox("Handle names", &display.names);
    ImGui::Checkbox("Axes", &display.axes);
    sample_overlays(ui);
}

// The rest of the camera is in the menu "View" and on keys; this is what a new cloud may need at once.
void up_choice(const Ui& ui) {
    inline_caption("Upwards", ui.scaled(92));
    constexpr std::array axes = {UpAxis::z, UpAxis::y, UpAxis::minus_y};
    const auto now = std::ranges::find(axes, ui.editor.camera.up) - axes.begin();
    const int up = segmented("up", std::array{"Z", "Y", "-Y"}, static_cast<int>(now));
    explain("Which axis of the file points upwards: for the ground, the horizon and the views 1, 3 and 7. A "
            "cloud "
            "that clearly stands on something begins with the right one; of others the choice is remembered");
    if (up >= 0) ui.wish(WishUpAxis{axes.at(static_cast<std::size_t>(up))});
}

} // namespace

void coloring_menu(const Ui& ui) {
    const bool open = ImGui::BeginMenu("Colour by", ui.has_cloud());
    if (!open) ui.state.menus.at_submenu |= ImGui::IsItemFocused();
    if (!open) return;
    coloring_items(ui, [](const char* name, bool chosen) { return ImGui::MenuItem(name, nullptr, chosen); });
    ImGui::EndMenu();
}

void display_panel(const Ui& ui) {
    if (!ui.has_cloud()) {
        faint_text("Colours, point size, lighting.");
        return;
    }
    coloring_choice(ui);
    range_fields(ui);
    size_slider(ui);
    overlays(ui);
    up_choice(ui);
}

} // namespace knead

// The editor's commands that select points and hide them.

#include "edit/editor_steps.h"
#include "view/visibility.h"

#include <algorithm>
#include <ranges>
#include <utility>

namespace knead {

namespace {

// The handle that a point of the file follows: the last one that holds it, and a region only where no other
// does; null: none.
const Handle* handle_of(const Editor& editor, Index point) {
    const auto holds_it = [&](const Handle& handle) {
        return std::ranges::binary_search(*handle.points, point);
    };
    const Handle* region = nullptr;
    for (const Handle& handle : editor.document->handles | std::views::reverse) {
        if (!holds_it(handle)) continue;
        if (handle.role != HandleRole::region_of_interest) return &handle;
        if (!region) region = &handle;
    }
    return region;
}

// The same of a point in the order; no_index: none.
const Handle* handle_that_holds(const Editor& editor, Index ordered) {
    if (ordered == no_index || !(editor.marks[ordered] & mark_handle)) return nullptr;
    return handle_of(editor, editor.opened.order->file_index[ordered]);
}

// Whether Shift and a click on a handle's points let it go along with the chosen one, as in the list. While
// points are selected that adds one to them.
bool could_go_along(const Editor& editor, const Handle& handle) {
    const Handle* const chosen = chosen_handle(editor);
    return editor.selected == 0 && chosen && chosen->role == HandleRole::moving &&
           handle.role == HandleRole::moving;
}

// Of what lies in a region: where less is seen, it is told.
constexpr double much_seen = 0.9;

} // namespace

std::vector<std::uint8_t> hidden_points(const Editor& editor) {
    std::vector<std::uint8_t> hidden;
    if (editor.hidden == 0) return hidden;
    hidden.resize(editor.marks.size());
    std::ranges::transform(editor.marks, hidden.begin(),
                           [](std::uint8_t mark) { return (mark & mark_hidden) ? 1 : 0; });
    return hidden;
}

std::string handle_under(Editor& editor, glm::dvec2 pixel) {
    const Handle* const handle =
        editor.document ? handle_that_holds(editor, point_clicked(editor, pixel)) : nullptr;
    return handle ? handle->name : std::string();
}

Index point_clicked(Editor& editor, glm::dvec2 pixel) {
    return point_under(editor.camera, editor.viewport, editor.frame.positions(), hidden_points(editor), pixel,
                       click_radius, editor.workers);
}

void carry_out(Editor& editor, const SelectRegion& command) {
    if (!needs_document(editor)) return;
    std::vector<std::uint8_t> inside(editor.marks.size());
    const std::vector<std::uint8_t> hidden = hidden_points(editor);
    points_in_region(editor.camera, editor.viewport, editor.frame.positions(), hidden, command.region, inside,
                     editor.workers);
    const auto count = [&] { return std::ranges::count(inside, std::uint8_t{1}); };
    const auto there = count();
    if (!command.through) {
        const VisibleSurface surface =
            visible_surface(editor.camera, editor.viewport, editor.frame.positions(), hidden,
                            editor.opened.spacing, editor.workers);
        keep_visible(editor.camera, editor.viewport, editor.frame.positions(), surface, inside,
                     editor.workers);
    }
    change_marks(editor, [&] { select(editor.marks, inside, command.mode, editor.workers); });
    const bool leaves_much = static_cast<double>(count()) < much_seen * static_cast<double>(there);
    if (leaves_much && command.mode != SelectMode::remove)
        editor.just_done = "Only what you see is selected (T selects what lies behind, too)";
}

// A click chooses the handle that it hits; elsewhere it selects the one point, or nothing, or what is around
// it.
void carry_out(Editor& editor, const SelectPointUnder& command) {
    if (!editor.document) return;
    const Index hit = point_clicked(editor, command.pixel);
    const Handle* const handle = handle_that_holds(editor, hit);
    if (handle && command.mode == SelectMode::replace) return carry_out(editor, ChooseHandle{handle->name});
    if (handle && command.mode == SelectMode::add && command.radius == 0 && could_go_along(editor, *handle))
        return carry_out(editor, ChooseAlso{handle->name});
    if (command.radius > 0)
        return carry_out(editor,
                         SelectRegion{ScreenStroke{{command.pixel}, command.radius},
                                      command.mode == SelectMode::replace ? SelectMode::add : command.mode,
                                      command.through});
    std::vector<std::uint8_t> inside(editor.marks.size());
    if (hit != no_index) inside[hit] = 1;
    const std::size_t steps = editor.past.size();
    change_marks(editor, [&] { select(editor.marks, inside, command.mode, editor.workers); });
    if (editor.past.size() > steps) editor.just_clicked = command.pixel;
}

void carry_out(Editor& editor, const ChangeSelection& command) {
    if (!needs_document(editor)) return;
    const bool needs_graph = command.step == SelectionStep::grow || command.step == SelectionStep::shrink ||
                             command.step == SelectionStep::connected ||
                             command.step == SelectionStep::outliers;
    if (needs_graph && !editor.document->graph)
        return say(editor, Notice::Kind::information,
                   "The neighbours of the points are still being found; try again in a moment.");
    if (command.step == SelectionStep::outliers && !editor.document->outliers)
        return say(editor, Notice::Kind::information,
                   "No point of this cloud lies off the surface by itself.");
    const PointOrder& order = *editor.opened.order;
    change_marks(editor, [&] {
        switch (command.step) {
        case SelectionStep::all:
            return select_all(editor.marks, editor.workers);
        case SelectionStep::none:
            return select_none(editor.marks, editor.workers);
        case SelectionStep::invert:
            return invert_selection(editor.marks, editor.workers);
        case SelectionStep::grow:
            return grow_selection(editor.marks, order, *editor.document->graph, editor.workers);
        case SelectionStep::shrink:
            return shrink_selection(editor.marks, order, *editor.document->graph, editor.workers);
        case SelectionStep::connected:
            return select_connected(editor.marks, order, *editor.document->components, editor.workers);
        case SelectionStep::outliers:
            return select_vertices(editor.marks, order, *editor.document->outliers, editor.workers);
        }
    });
}

void carry_out(Editor& editor, const ChangeHidden& command) {
    if (!needs_document(editor)) return;
    if (command.step == HideStep::hide_unselected && editor.selected == 0)
        return say(editor, Notice::Kind::information,
                   "Select what is to stay visible first: with nothing selected all would be hidden.");
    change_marks(editor, [&] {
        if (command.step == HideStep::show_all) return show_all(editor.marks, editor.workers);
        hide(editor.marks, command.step == HideStep::hide_selected, editor.workers);
    });
}

} // namespace knead

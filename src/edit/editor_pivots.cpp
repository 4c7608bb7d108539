// The points that handles turn about and grow from, where the user moved them: each handle keeps its own,
// which goes with it.

#include "edit/editor_steps.h"
#include "view/middle_along.h"

#include <algorithm>
#include <cmath>

namespace knead {

std::optional<glm::dvec3> pivot_of(const Editor& editor, const std::string& handle) {
    const auto found = editor.pivots.find(handle);
    if (found == editor.pivots.end()) return std::nullopt;
    return found->second;
}

namespace {

// Whether a document that has heard of all steps would find nothing to change: no line told of the pivot that
// goes, which was known by where the handle was dragged about.
bool is_of_no_line(const Editor& editor, const PivotMove& move) {
    const auto number = number_of(editor, move.handle);
    return !move.after && !has_pending_steps(editor) && number && !editor.document->handles[*number].pivot;
}

// While moves are mirrored, so are the joints that they go by.
std::vector<PivotMove> with_counterpart(const Editor& editor, const PivotMove& move) {
    std::vector<PivotMove> moves{move};
    if (const auto across = joint_across(editor, move.handle, move.after.value_or(glm::dvec3(0.0)))) {
        const std::optional<glm::dvec3> before = pivot_of(editor, across->handle);
        const std::optional<glm::dvec3> after = move.after ? std::optional(across->pivot) : std::nullopt;
        if (before != after) moves.push_back({across->handle, before, after});
    }
    return moves;
}

// As one step.
void put_pivots(Editor& editor, std::vector<PivotMove> moves) {
    const bool are_of_lines =
        std::ranges::any_of(moves, [&](const PivotMove& move) { return !is_of_no_line(editor, move); });
    EditorStep step = coming_step(editor, are_of_lines ? ++editor.last_step : 0);
    step.chosen_before = step.chosen_after = moves[0].handle;
    std::vector<PivotPlace> places;
    for (auto move = moves.rbegin(); move != moves.rend(); ++move) { // the last one names the step
        places.push_back({move->handle, std::nullopt});
        if (move->after) places.back().place = to_eigen(*move->after) + editor.opened.cloud->origin;
    }
    if (step.document) editor.live->put_pivots(step.document, std::move(places));
    for (const PivotMove& move : moves) put_pivot(editor, move.handle, move.after);
    step.pivots = std::move(moves);
    add_step(editor, std::move(step));
}

} // namespace

void put_pivot(Editor& editor, const std::string& handle, const std::optional<glm::dvec3>& pivot) {
    if (pivot)
        editor.pivots[handle] = *pivot;
    else
        editor.pivots.erase(handle);
}

void put_pivot_with(EditorStep& step, Editor& editor, const std::string& handle,
                    const std::optional<glm::dvec3>& pivot) {
    const auto before = pivot_of(editor, handle);
    if (before == pivot) return;
    step.pivots.push_back({handle, before, pivot});
    put_pivot(editor, handle, pivot);
}

void take_pivots_back(Editor& editor, const EditorStep& step) {
    for (auto move = step.pivots.rbegin(); move != step.pivots.rend(); ++move)
        put_pivot(editor, move->handle, move->before);
}

void carry_out(Editor& editor, const SetPivot& command) {
    if (editor.chosen.empty()) return;
    if (!editor.moved_pivot) editor.moved_pivot = PivotMove{editor.chosen, pivot_of(editor, editor.chosen)};
    PivotMove& move = *editor.moved_pivot;
    move.after = command.stage == SetPivot::Stage::given_up ? move.before : command.pivot;
    put_pivot(editor, move.handle, move.after);
    if (command.stage == SetPivot::Stage::moving) return;
    if (move.after != move.before) put_pivots(editor, with_counterpart(editor, move));
    editor.moved_pivot.reset();
}

void carry_out(Editor& editor, const SetPivotInside& command) {
    if (!needs_document(editor)) return;
    const Ray ray = ray_through(editor.camera, editor.viewport, command.pixel);
    const auto middle = middle_along(ray, editor.camera.orthographic, editor.frame.positions(),
                                     hidden_points(editor), editor.opened.spacing, editor.workers);
    if (middle) carry_out(editor, SetPivot{middle});
}

void carry_out(Editor& editor, const SetPivotToSelection& /*command*/) {
    if (!needs_document(editor) || editor.selected == 0) return;
    glm::dvec3 sum(0.0);
    std::size_t count = 0;
    for (std::size_t i = 0; i < editor.marks.size(); ++i) {
        const float* const p = editor.frame.positions().data() + 3 * i;
        if (!(editor.marks[i] & mark_selected) || !std::isfinite(p[0] + p[1] + p[2])) continue;
        sum += glm::dvec3(p[0], p[1], p[2]);
        ++count;
    }
    if (count > 0) carry_out(editor, SetPivot{sum / static_cast<double>(count)});
}

} // namespace knead

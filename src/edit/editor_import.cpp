#include "edit/editor_import.h"

#include "base/counts.h"
#include "base/error.h"
#include "base/quoted.h"
#include "edit/cures.h"
#include "edit/editor_steps.h"
#include "edit/json_text.h"
#include "edit/standing_acts.h"

#include <algorithm>
#include <optional>
#include <set>
#include <unordered_map>
#include <utility>

namespace knead {

namespace {

// Whole numbers of 32 bits at most. Wider columns count or measure (times, serial numbers) and name no parts.
bool may_hold_labels(ScalarType type) {
    return is_whole(type) && size_of(type) <= 4;
}

std::int64_t label_at(const Attribute& attribute, std::size_t point) {
    return static_cast<std::int64_t>(value_at(attribute, point));
}

// The values that occur and how often; nothing where there are too many.
std::optional<std::vector<LabelColumn::Value>> values_of(const Attribute& attribute, std::size_t points) {
    std::unordered_map<std::int64_t, std::size_t> counts;
    for (std::size_t i = 0; i < points; ++i)
        if (++counts[label_at(attribute, i)] == 1 && counts.size() > most_labels) return std::nullopt;
    std::vector<LabelColumn::Value> values;
    values.reserve(counts.size());
    for (const auto& [value, count] : counts) values.push_back({value, count});
    std::ranges::sort(values, {}, &LabelColumn::Value::value);
    return values;
}

std::string& name_of(SessionAction& line) {
    return std::get<HandleLine>(line).name;
}

// Posts handles as one step. `besides`: what else is to be said of them.
void post_handles(Editor& editor, std::vector<SessionAction> lines, const std::string& besides) {
    const std::size_t count = lines.size();
    std::vector<std::pair<std::string, std::optional<Vec3d>>> made; // names and pivots
    for (SessionAction& line : lines) made.emplace_back(name_of(line), std::get<HandleLine>(line).pivot);
    const StepNumber step = post_step(editor, std::move(lines));
    for (auto& [name, pivot] : made) {
        const Vec3d& origin = editor.opened.cloud->origin;
        put_pivot_with(editor.past.back(), editor, name,
                       pivot ? std::optional(to_glm(*pivot - origin)) : std::nullopt);
        editor.posted_names.emplace_back(step, std::move(name));
    }
    say(editor, Notice::Kind::information, "Made " + counted(count, "handle") + "." + besides);
}

// Another name for each whose own is taken; returns what to say of it.
std::string take_free_names(const Editor& editor, std::vector<SessionAction>& lines) {
    std::set<std::string> given;
    std::string renamed;
    for (SessionAction& line : lines) {
        std::string& name = name_of(line);
        const std::string wanted = name;
        for (unsigned number = 2; !is_free(editor, name) || given.contains(name); ++number)
            name = wanted + " (" + std::to_string(number) + ")";
        given.insert(name);
        if (name == wanted) continue;
        renamed += renamed.empty() ? " " : ", ";
        renamed += knead::quoted(wanted) + " is called " + knead::quoted(name);
    }
    return renamed.empty() ? "" : renamed + ", as there was one of that name.";
}

// What to say of those that take the places of others.
std::string words_about_replaced(const Editor& editor, std::vector<SessionAction>& lines) {
    const auto replaced =
        std::ranges::count_if(lines, [&](SessionAction& line) { return !is_free(editor, name_of(line)); });
    return replaced == 0 ? ""
                         : " Of these, " + std::to_string(replaced) + " took the place of one of that name.";
}

// Handles of a session, in the order of their last lines, under the names that they have by now. Points are
// many, so the lines stay where they are.
struct NamedLine {
    std::string name;
    const SessionLine* line = nullptr; // of a HandleLine
};
using HandleLines = std::vector<NamedLine>;

void remove(HandleLines& handles, const std::string& name) {
    std::erase_if(handles, [&](const NamedLine& handle) { return handle.name == name; });
}

// Those that stand at the end.
HandleLines handles_at_end(const Session& session) {
    HandleLines handles;
    for (const StandingAct& act : acts_after(session.lines).done) {
        const SessionAction& action = act.line->action;
        if (const auto* made = std::get_if<HandleLine>(&action)) {
            remove(handles, made->name);
            handles.push_back({made->name, act.line});
        }
        if (const auto* gone = std::get_if<DeleteLine>(&action)) remove(handles, gone->handle);
        if (const auto* named = std::get_if<RenameLine>(&action))
            for (NamedLine& handle : handles)
                if (handle.name == named->handle) handle.name = named->to;
    }
    return handles;
}

// Whether a handle names its points by their numbers, which mean others in another cloud; a region does not.
bool is_of_numbers(const NamedLine& handle) {
    return std::holds_alternative<std::vector<IndexRange>>(std::get<HandleLine>(handle.line->action).points);
}

// The lines with points instead of regions, as a recording has them. Throws Error (input).
std::vector<SessionAction> with_points(const Editor& editor, const Session& session,
                                       const HandleLines& handles) {
    const PointCloud& cloud = *editor.opened.cloud;
    const auto place_of = [&](std::size_t i) -> Vec3d {
        const Index at = editor.ordered[i];
        if (at == no_index) return cloud.file_position(i);
        const float* p = editor.frame.positions().data() + 3 * std::size_t{at};
        return cloud.origin + Vec3f(p[0], p[1], p[2]).cast<double>();
    };
    const auto acts = acts_after(session.lines).done;
    const bool is_at_rest = !editor.document->rest && !is_or_will_be_posed(editor) &&
                            std::ranges::none_of(acts, [](const StandingAct& act) {
                                return std::holds_alternative<CommitLine>(act.line->action);
                            });
    std::vector<SessionAction> lines;
    for (const auto& [name, from] : handles) {
        HandleLine line = std::get<HandleLine>(from->action);
        std::vector<IndexRange> ranges;
        for (const Index i : resolve_points(line, cloud, place_of, session.place(from->number)))
            append_point(ranges, i);
        line.points = std::move(ranges);
        line.name = name;
        if (!is_at_rest) line.pivot = std::nullopt; // it was told of another shape
        lines.emplace_back(std::move(line));
    }
    return lines;
}

} // namespace

std::vector<LabelColumn> label_columns(const PointCloud& cloud) {
    std::vector<LabelColumn> columns;
    for (std::size_t a = 0; a < cloud.attributes.size(); ++a) {
        const Attribute& attribute = cloud.attributes[a];
        if (attribute.is_list() || !may_hold_labels(attribute.type)) continue;
        if (std::ranges::find(cloud.coordinate_columns, a) != cloud.coordinate_columns.end()) continue;
        auto values = values_of(attribute, cloud.size());
        if (!values || values->size() < 2) continue;
        LabelColumn column{attribute.name, std::move(*values), 0};
        const auto commonest = std::ranges::max_element(column.values, {}, &LabelColumn::Value::points);
        column.commonest = static_cast<std::size_t>(commonest - column.values.begin());
        columns.push_back(std::move(column));
    }
    return columns;
}

void handles_from_labels(Editor& editor, const std::string& column, std::span<const LabelChoice> choices) {
    if (!needs_document(editor) || !may_act(editor) || !may_go_on_from_pose(editor)) return;
    const PointCloud& cloud = *editor.opened.cloud;
    const auto number = find_attribute(cloud, column);
    if (!number || cloud.attributes[*number].is_list() || !may_hold_labels(cloud.attributes[*number].type))
        return say(editor, Notice::Kind::error,
                   "The cloud has no column of whole numbers called " + quoted(column) + ".");
    std::unordered_map<std::int64_t, std::vector<IndexRange>> points;
    for (const LabelChoice& choice : choices) points[choice.value] = {};
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        if (editor.ordered[i] == no_index) continue;
        const auto found = points.find(label_at(cloud.attributes[*number], i));
        if (found != points.end()) append_point(found->second, i);
    }
    std::vector<SessionAction> lines;
    for (const LabelChoice& choice : choices) {
        std::vector<IndexRange>& ranges = points[choice.value];
        if (ranges.empty()) continue;
        HandleLine line;
        line.name = utf8_of(column) + " " + std::to_string(choice.value);
        line.role = choice.role;
        line.points = std::exchange(ranges, {});
        lines.emplace_back(std::move(line));
    }
    if (lines.empty())
        return say(editor, Notice::Kind::information, "No points have the chosen values of " + column + ".");
    const std::string besides = words_about_replaced(editor, lines);
    post_handles(editor, std::move(lines), besides);
}

void handles_from_session(Editor& editor, const std::filesystem::path& session) {
    if (!needs_document(editor) || !may_act(editor) || !may_go_on_from_pose(editor)) return;
    try {
        const Session read = read_session(session);
        const HandleLines handles = handles_at_end(read);
        if (handles.empty())
            return say(editor, Notice::Kind::information,
                       session.filename().string() + " has no handles at its end.");
        const std::size_t points = editor.opened.cloud->size();
        if (read.points.value_or(points) != points && std::ranges::any_of(handles, is_of_numbers))
            return say(editor, Notice::Kind::error,
                       "No handles were made. " + session.filename().string() + " is of a cloud of " +
                           counted(*read.points, "point") + ", and this one has " + grouped(points) +
                           ": its handles name points by number, which are others here.");
        std::vector<SessionAction> lines = with_points(editor, read, handles);
        const std::string besides = take_free_names(editor, lines);
        post_handles(editor, std::move(lines), besides);
    } catch (const std::exception& error) {
        say(editor, Notice::Kind::error, "No handles were made. " + words_in_window(error));
    }
}

} // namespace knead

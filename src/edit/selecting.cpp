#include "edit/selecting.h"

#include "edit/handles.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t grain = 1 << 15;

// Which vertices have a point that is selected (and seen).
std::vector<std::uint8_t> selected_vertices(std::span<const std::uint8_t> marks, const PointOrder& order) {
    std::vector<std::uint8_t> selected(order.vertices(), 0);
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (marks[i] & mark_selected) selected[order.vertex[i]] = 1;
    return selected;
}

// A vertex and its neighbours: those with any (or all) of them selected.
std::vector<std::uint8_t> spread(std::span<const std::uint8_t> selected, const Graph& graph, bool outwards,
                                 Workers& workers) {
    std::vector<std::uint8_t> result(selected.size());
    workers.for_each(selected.size(), grain, [&](std::size_t v) {
        const auto is_selected = [&](Index u) { return selected[u] != 0; };
        result[v] = outwards ? selected[v] || std::ranges::any_of(graph.row(v), is_selected)
                             : selected[v] && std::ranges::all_of(graph.row(v), is_selected);
    });
    return result;
}

} // namespace

void select(std::span<std::uint8_t> marks, std::span<const std::uint8_t> inside, SelectMode mode,
            Workers& workers) {
    workers.for_each(marks.size(), grain, [&](std::size_t i) {
        std::uint8_t& mark = marks[i];
        if (mark & mark_hidden) return;
        if (mode == SelectMode::replace) mark = static_cast<std::uint8_t>(mark & ~mark_selected);
        if (!inside[i]) return;
        mark = static_cast<std::uint8_t>(mode == SelectMode::remove ? mark & ~mark_selected
                                                                    : mark | mark_selected);
    });
}

void select_all(std::span<std::uint8_t> marks, Workers& workers) {
    workers.for_each(marks.size(), grain, [&](std::size_t i) {
        if (!(marks[i] & mark_hidden)) marks[i] |= mark_selected;
    });
}

void select_none(std::span<std::uint8_t> marks, Workers& workers) {
    workers.for_each(marks.size(), grain,
                     [&](std::size_t i) { marks[i] = static_cast<std::uint8_t>(marks[i] & ~mark_selected); });
}

void invert_selection(std::span<std::uint8_t> marks, Workers& workers) {
    workers.for_each(marks.size(), grain, [&](std::size_t i) {
        if (!(marks[i] & mark_hidden)) marks[i] ^= mark_selected;
    });
}

void select_vertices(std::span<std::uint8_t> marks, const PointOrder& order,
                     std::span<const std::uint8_t> selected, Workers& workers) {
    workers.for_each(marks.size(), grain, [&](std::size_t i) {
        if (marks[i] & mark_hidden) return;
        marks[i] = static_cast<std::uint8_t>((marks[i] & ~mark_selected) |
                                             (selected[order.vertex[i]] ? mark_selected : 0));
    });
}

void grow_selection(std::span<std::uint8_t> marks, const PointOrder& order, const Graph& graph,
                    Workers& workers) {
    select_vertices(marks, order, spread(selected_vertices(marks, order), graph, true, workers), workers);
}

void shrink_selection(std::span<std::uint8_t> marks, const PointOrder& order, const Graph& graph,
                      Workers& workers) {
    select_vertices(marks, order, spread(selected_vertices(marks, order), graph, false, workers), workers);
}

void select_connected(std::span<std::uint8_t> marks, const PointOrder& order, const Components& components,
                      Workers& workers) {
    std::vector<std::uint8_t> chosen(components.size.size(), 0);
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (marks[i] & mark_selected) chosen[components.component[order.vertex[i]]] = 1;
    workers.for_each(marks.size(), grain, [&](std::size_t i) {
        if (!(marks[i] & mark_hidden) && chosen[components.component[order.vertex[i]]])
            marks[i] |= mark_selected;
    });
}

void hide(std::span<std::uint8_t> marks, bool selected_ones, Workers& workers) {
    workers.for_each(marks.size(), grain, [&](std::size_t i) {
        const bool selected = (marks[i] & mark_selected) != 0;
        if (selected != selected_ones) return;
        marks[i] = static_cast<std::uint8_t>((marks[i] & ~mark_selected) | mark_hidden);
    });
}

void show_all(std::span<std::uint8_t> marks, Workers& workers) {
    workers.for_each(marks.size(), grain,
                     [&](std::size_t i) { marks[i] = static_cast<std::uint8_t>(marks[i] & ~mark_hidden); });
}

std::vector<IndexRange> selected_ranges(std::span<const std::uint8_t> marks, const PointOrder& order,
                                        std::size_t file_points) {
    std::vector<bool> selected(file_points, false);
    for (std::size_t i = 0; i < marks.size(); ++i)
        if (marks[i] & mark_selected) selected[order.file_index[i]] = true;
    std::vector<IndexRange> ranges;
    for (std::size_t i = 0; i < file_points; ++i) {
        if (selected[i]) append_point(ranges, i);
    }
    return ranges;
}

MarkCounts count_marks(std::span<const std::uint8_t> marks) {
    MarkCounts counts;
    for (const std::uint8_t mark : marks) {
        counts.selected += (mark & mark_selected) != 0;
        counts.hidden += (mark & mark_hidden) != 0;
    }
    return counts;
}

std::vector<Index> first_selected(std::span<const std::uint8_t> marks, std::size_t most) {
    std::vector<Index> found;
    constexpr std::size_t at_once = 64;
    for (std::size_t first = 0; first < marks.size() && found.size() < most; first += at_once) {
        const auto part = marks.subspan(first, std::min(at_once, marks.size() - first));
        std::uint8_t any = 0; // without a branch in it: the processor takes many at a time
        for (const std::uint8_t mark : part) any |= mark;
        if (!(any & mark_selected)) continue;
        for (std::size_t k = 0; k < part.size() && found.size() < most; ++k)
            if (part[k] & mark_selected) found.push_back(static_cast<Index>(first + k));
    }
    return found;
}

} // namespace knead

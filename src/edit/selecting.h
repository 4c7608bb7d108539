#pragma once
// What selecting does to the marks of the points (view/marks.h).

#include "base/types.h"
#include "base/workers.h"
#include "edit/select_mode.h"
#include "edit/session.h"
#include "graph/csr.h"
#include "graph/neighbors.h"
#include "graph/point_order.h"
#include "view/marks.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

inline constexpr std::uint8_t marks_of_selection = mark_hidden | mark_selected;

// Changes the selection by the points that `inside` names with 1. Hidden points are left alone, also by the
// functions below.
void select(std::span<std::uint8_t> marks, std::span<const std::uint8_t> inside, SelectMode mode,
            Workers& workers);

void select_all(std::span<std::uint8_t> marks, Workers& workers);
void select_none(std::span<std::uint8_t> marks, Workers& workers);
void invert_selection(std::span<std::uint8_t> marks, Workers& workers);

// By one link of the graph outwards, or inwards.
void grow_selection(std::span<std::uint8_t> marks, const PointOrder& order, const Graph& graph,
                    Workers& workers);
void shrink_selection(std::span<std::uint8_t> marks, const PointOrder& order, const Graph& graph,
                      Workers& workers);
// All that hangs together with what is selected.
void select_connected(std::span<std::uint8_t> marks, const PointOrder& order, const Components& components,
                      Workers& workers);

// The points of the vertices with a 1, and no others.
void select_vertices(std::span<std::uint8_t> marks, const PointOrder& order,
                     std::span<const std::uint8_t> selected, Workers& workers);

// Hiding takes points out of the selection.
void hide(std::span<std::uint8_t> marks, bool selected_ones, Workers& workers);
void show_all(std::span<std::uint8_t> marks, Workers& workers);

// The file's indices of the selected points, as ascending ranges.
std::vector<IndexRange> selected_ranges(std::span<const std::uint8_t> marks, const PointOrder& order,
                                        std::size_t file_points);

struct MarkCounts {
    std::size_t selected = 0, hidden = 0;
};
MarkCounts count_marks(std::span<const std::uint8_t> marks);

// The selected points, so many of them at most, in the order of the marks. Hardly slower than reading the
// marks up to there.
std::vector<Index> first_selected(std::span<const std::uint8_t> marks, std::size_t most);

} // namespace knead

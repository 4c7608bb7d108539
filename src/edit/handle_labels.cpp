#include "edit/handle_labels.h"

#include "base/workers.h"
#include "graph/point_order.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t grain = 1 << 14;

// Which of two labels a vertex takes that has points of both.
Index stronger(Index a, Index b, Index outside) {
    if (a == no_index) return b;
    if (b == no_index) return a;
    if (a == outside) return b;
    if (b == outside) return a;
    return std::max(a, b);
}

// Labels in numbers that are as narrow as will do: they are looked up in no order, and should fit into a
// cache.
template<typename Label>
void label_by(const std::vector<Handle>& handles, const PointOrder& order, std::size_t file_points,
              Workers& workers, HandleLabels& labels) {
    constexpr Label free = std::numeric_limits<Label>::max();
    const auto is_region = [](const Handle& handle) { return handle.role == HandleRole::region_of_interest; };
    const auto outside = static_cast<Label>(handles.size());
    std::vector<Label> of_file_point(file_points, std::ranges::any_of(handles, is_region) ? outside : free);
    for (const bool region_pass : {true, false})
        for (std::size_t h = 0; h < handles.size(); ++h) {
            if (!handles[h].points || is_region(handles[h]) != region_pass) continue;
            const Label label = region_pass ? free : static_cast<Label>(h);
            const std::vector<Index>& points = *handles[h].points;
            workers.for_each(points.size(), grain, [&](std::size_t i) { of_file_point[points[i]] = label; });
        }

    labels.outside = outside;
    labels.point.resize(order.points(), no_index);
    labels.vertex.resize(order.vertices(), no_index);
    labels.held.resize(blocks_of_rows(order.vertices()), 0);
    labels.changed.resize(labels.held.size(), 0);
    workers.for_each(labels.held.size(), grain / rows_in_block, [&](std::size_t block) {
        const auto [begin, end] = rows_of_block(block, order.vertices());
        const auto is_held = [&](Index file_index) { return of_file_point[file_index] != free; };
        const bool held = std::any_of(order.file_index.begin() + order.first_point[begin],
                                      order.file_index.begin() + order.first_point[end], is_held);
        if (!held && !labels.held[block]) return;
        bool changed = false;
        for (Index i = order.first_point[begin]; i < order.first_point[end]; ++i) {
            const Label label = of_file_point[order.file_index[i]];
            const Index before = std::exchange(labels.point[i], label == free ? no_index : Index{label});
            changed |= labels.point[i] != before;
        }
        if (!changed) return;
        labels.held[block] = held ? 1 : 0;
        labels.changed[block] = 1;
        for (std::size_t v = begin; v < end; ++v) {
            labels.vertex[v] = no_index;
            for (Index i = order.first_point[v]; i < order.first_point[v + 1]; ++i)
                labels.vertex[v] = stronger(labels.vertex[v], labels.point[i], outside);
        }
    });
}

} // namespace

void label_points(const std::vector<Handle>& handles, const PointOrder& order, std::size_t file_points,
                  Workers& workers, HandleLabels& labels) {
    if (handles.size() < std::numeric_limits<std::uint8_t>::max())
        label_by<std::uint8_t>(handles, order, file_points, workers, labels);
    else
        label_by<Index>(handles, order, file_points, workers, labels);
}

} // namespace knead

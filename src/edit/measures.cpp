#include "edit/measures.h"

#include "base/types.h"

namespace knead {

namespace {

constexpr std::size_t grain = 4096;

} // namespace

std::vector<float> displacements(std::span<const float> opened, std::span<const float> now,
                                 Workers& workers) {
    std::vector<float> result(now.size() / 3);
    workers.for_each(result.size(), grain, [&](std::size_t i) {
        result[i] = static_cast<float>((point_at(now, i) - point_at(opened, i)).norm());
    });
    return result;
}

std::vector<float> local_stretch(const PointOrder& order, const Graph& graph, std::span<const float> opened,
                                 std::span<const float> now, Workers& workers) {
    std::vector<float> of_vertex(order.vertices(), 1.0F);
    workers.for_each(of_vertex.size(), grain, [&](std::size_t v) {
        const Index here = order.first_point[v];
        double sum = 0;
        for (const Index u : graph.row(v)) {
            const Index there = order.first_point[u];
            sum += (point_at(now, there) - point_at(now, here)).norm() /
                   (point_at(opened, there) - point_at(opened, here)).norm();
        }
        const std::size_t links = graph.row(v).size();
        if (links > 0) of_vertex[v] = static_cast<float>(sum / static_cast<double>(links));
    });
    std::vector<float> result(order.points());
    workers.for_each(result.size(), grain, [&](std::size_t i) { result[i] = of_vertex[order.vertex[i]]; });
    return result;
}

std::vector<float> in_file_order(const PointOrder& order, std::span<const float> ordered,
                                 std::size_t file_points, float left_out, Workers& workers) {
    std::vector<float> values(file_points, left_out);
    scatter(order, ordered, 1, values, workers);
    return values;
}

} // namespace knead

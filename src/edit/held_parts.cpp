#include "edit/held_parts.h"

#include <algorithm>
#include <optional>

namespace knead {

namespace {

// What the links of a vertex are like.
struct LinksAround {
    double levels = 0; // of one, in the mean
    double length = 0; // of a level
};

LinksAround links_around(const SampledCloud& cloud, Index vertex) {
    const Vec3d place = point_at(cloud.positions, vertex);
    const auto row = cloud.graph.row(vertex);
    double levels = 0, length = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
        levels += cloud.lengths[cloud.graph.first[vertex] + k];
        length += (point_at(cloud.positions, row[k]) - place).norm();
    }
    if (!(length > 0)) return {};
    return {levels / static_cast<double>(row.size()), length / levels};
}

// How far a vertex is from the border of a handle, in levels, if its row tells.
std::optional<double> way_to(const SampledCloud& cloud, Index vertex, Index handle) {
    const WideRow row = cloud.nearest[vertex];
    const auto* const at = std::ranges::find(row.sample, cloud.nearest.first_handle + handle);
    if (at == row.sample.end()) return std::nullopt;
    return row.distance.at(static_cast<std::size_t>(at - row.sample.begin()));
}

// Of a link between these vertices.
float held_part(const SampledCloud& cloud, Index free, Index held) {
    const LinksAround around = links_around(cloud, held);
    if (!(around.length > 0)) return 0.5F;
    const Index handle = cloud.label[held];
    const std::optional<double> in_handle = way_to(cloud, held, handle);
    const std::optional<double> outside = way_to(cloud, free, handle);
    const double straight =
        (point_at(cloud.positions, free) - point_at(cloud.positions, held)).norm() / around.length;
    const double whole = in_handle && outside ? *in_handle + *outside : straight;
    const double on_handle = (in_handle ? *in_handle : 0.5 * whole) + 0.5 * around.levels;
    return static_cast<float>(std::clamp(on_handle / whole, 0.0, 1.0));
}

} // namespace

std::vector<float> held_parts(const SampledCloud& cloud, Workers& workers) {
    constexpr std::size_t grain = 1024;
    std::vector<float> parts(cloud.between.neighbor.size(), 0);
    const bool every_point = cloud.nearest.size() == 0;
    workers.for_each(cloud.between.size(), grain, [&](std::size_t i) {
        const Index free = cloud.samples[i];
        if (cloud.label[free] != no_index) return;
        for (Index link = cloud.between.first[i]; link < cloud.between.first[i + 1]; ++link) {
            const Index held = cloud.samples[cloud.between.neighbor[link]];
            if (cloud.label[held] != no_index)
                parts[link] = every_point ? 0.5F : held_part(cloud, free, held);
        }
    });
    return parts;
}

} // namespace knead

#include "view/screen_region.h"

#include "base/require.h"
#include "view/projector.h"
#include "view/region_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr std::size_t grain = 16384; // points a chunk

// Fills inside[i] with what `contains(x, y)` says of each point's pixel.
template<typename Contains>
void test_points(const Projector& projector, std::span<const float> positions,
                 std::span<const std::uint8_t> hidden, std::span<std::uint8_t> inside, Workers& workers,
                 Contains&& contains_pixel) {
    workers.for_chunks(inside.size(), grain, [&](std::size_t begin, std::size_t end) {
        project_each(
            projector, positions.data(), begin, end, [&](std::size_t i, const Projector::Seen& seen) {
                const bool shown = hidden.empty() || hidden[i] == 0;
                // No branches: nobody can guess which points are inside.
                inside[i] = static_cast<std::uint8_t>(int{shown} & int{projector.in_front(seen.depth)} &
                                                      int{contains_pixel(seen.x, seen.y)});
            });
    });
}

} // namespace

void points_in_region(const Camera& camera, Viewport viewport, std::span<const float> positions,
                      std::span<const std::uint8_t> hidden, const ScreenRegion& region,
                      std::span<std::uint8_t> inside, Workers& workers) {
    require(inside.size() * 3 == positions.size(), "one byte a point");
    require(hidden.empty() || hidden.size() == inside.size(), "one byte a point, or none");
    const Projector projector(camera, viewport);
    if (const auto* box = std::get_if<ScreenBox>(&region)) {
        const glm::dvec2 lowest = glm::min(box->corner, box->opposite);
        const glm::dvec2 highest = glm::max(box->corner, box->opposite);
        test_points(projector, positions, hidden, inside, workers, [=](double x, double y) {
            return (x >= lowest.x) & (x <= highest.x) & (y >= lowest.y) & (y <= highest.y);
        });
        return;
    }
    const RegionGrid grid(region);
    test_points(projector, positions, hidden, inside, workers,
                [&](double x, double y) { return grid.contains(x, y); });
}

Index point_under(const Camera& camera, Viewport viewport, std::span<const float> positions,
                  std::span<const std::uint8_t> hidden, glm::dvec2 pixel, double radius, Workers& workers) {
    const Projector projector(camera, viewport);
    const std::size_t count = positions.size() / 3;
    struct Nearest {
        double depth = std::numeric_limits<double>::infinity();
        Index point = no_index;
    };
    std::vector<Nearest> nearest((count + grain - 1) / grain); // of every chunk
    workers.for_chunks(count, grain, [&](std::size_t begin, std::size_t end) {
        Nearest best;
        for (std::size_t i = begin; i < end; ++i) {
            const Projector::Seen seen = projector(positions.data() + 3 * i);
            const double x = seen.x - pixel.x;
            const double y = seen.y - pixel.y;
            if (!(seen.depth < best.depth && x * x + y * y <= radius * radius)) continue;
            if (!projector.in_front(seen.depth) || (!hidden.empty() && hidden[i] != 0)) continue;
            best = {seen.depth, static_cast<Index>(i)};
        }
        nearest[begin / grain] = best;
    });
    // Of equals the first: chunks stand in the order of the points.
    const auto best = std::ranges::min_element(nearest, {}, &Nearest::depth);
    return best == nearest.end() ? no_index : best->point;
}

} // namespace knead

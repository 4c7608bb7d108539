#include "graph/vertex_areas.h"

#include "graph/bridges.h"
#include "graph/cell_area.h"
#include "graph/star_weights.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace knead {

namespace {

// More hardly change what one vertex finds out by itself.
constexpr int updates = 2;

// What links come to, over the surface that their vertex stands for.
constexpr double links_over_area = 6;

// From 1 at the first bound to 0 at the other.
struct Fade {
    double all, nothing;

    double at(double value) const { return std::clamp((value - nothing) / (all - nothing), 0.0, 1.0); }
};

// Noise of half a spacing makes a surface as thick as 0.1, of three quarters 0.18; in a solid it is 0.4 on
// the mean, and rarely less than 0.2.
constexpr Fade is_surface{0.2, 0.4};
constexpr double thick = 0.3; // (graph/solid_links.h tells of each vertex, and has to look at all for it)
// The surroundings of one of a row of points have no width, those on a rim a quarter.
constexpr Fade has_width{0.1, 0.04};
// Over the links' root mean square: of points that were thrown at random one of twenty reaches as far as the
// first.
constexpr Fade is_inside{2.0, 3.0};

// What one vertex says.
struct Told {
    double star = 0, links = 0, cell = 0;
    double is_cell = 0;    // how far the area is that of the cell
    double square_way = 0; // to what is around
    bool asked = false;    // for the cell
    bool thick = false;
};

// One after the other in the same memory.
class Teller {
public:
    Teller(const Graph& points, std::span<const float> positions, const Numbering& point,
           std::span<const std::uint8_t> hanging)
        : points_(points), positions_(positions), point_(point), hanging_(hanging),
          cells_(points, positions, point, hanging) {}

    Told tell(Index vertex, bool with_cell) {
        Told told;
        told.asked = with_cell;
        if (hangs(hanging_, vertex)) return told;
        star_.clear();
        const Vec3d own = point_at(positions_, point_[vertex]);
        for (const Index other : points_.row(vertex))
            if (!hangs(hanging_, other))
                star_.push_back(spoke_along(point_at(positions_, point_[other]) - own, 1));
        if (star_.empty()) return told;
        weight_.assign(star_.size(), 1.0);
        const double square = area_of(star_, weight_) / static_cast<double>(star_.size());
        const double share = share_of_directions(pull_of(star_, weight_));
        told.links = links_over_area * square * share;
        const double sum = start_weights(star_, weight_);
        for (int update = 0; update < updates; ++update) even_out(star_, sum, weight_);
        told.star = area_of(star_, weight_);
        if (!with_cell || !(square > 0)) return told; // all in one place
        const Cell cell = cells_.find(vertex);
        const double inside = is_inside.at(cell.reach / std::sqrt(square));
        const double area = inside < 1 ? std::lerp(share * cells_.mirrored(), cell.area, inside) : cell.area;
        told.cell = links_over_area * area;
        told.is_cell = is_surface.at(cell.thickness) * has_width.at(cell.width);
        told.square_way = cell.square_way;
        told.thick = cell.thickness > thick;
        return told;
    }

private:
    const Graph& points_;
    std::span<const float> positions_;
    const Numbering& point_;
    std::span<const std::uint8_t> hanging_;
    CellFinder cells_;
    std::vector<Spoke> star_;
    std::vector<double> weight_;
};

std::vector<double> areas_of(std::span<const Told> told) {
    std::vector<double> areas;
    for (const Told& each : told)
        areas.push_back(each.asked ? std::lerp(each.star, each.cell, each.is_cell) : -1);
    return areas;
}

std::vector<double> volumes_of(std::span<const Told> told) {
    std::vector<double> ways;
    for (const Told& each : told)
        if (each.square_way > 0) ways.push_back(each.square_way);
    if (ways.empty()) return areas_of(told);
    const auto middle = ways.begin() + static_cast<std::ptrdiff_t>(ways.size() / 2);
    std::ranges::nth_element(ways, middle);
    std::vector<double> volumes;
    for (const Told& each : told)
        volumes.push_back(each.asked ? each.star * std::sqrt(each.square_way / *middle) : -1);
    return volumes;
}

} // namespace

AskedVertices ask_vertices(const Graph& points, std::span<const float> positions, const Numbering& point,
                           std::span<const std::uint8_t> hanging, ChosenVertices chosen, std::size_t of_cells,
                           Workers& workers) {
    AskedVertices asked;
    asked.vertex = std::move(chosen.vertex);
    asked.each = std::move(chosen.each);
    asked.all = chosen.all && of_cells == 1;
    const std::size_t count = asked.vertex.size();
    std::vector<Told> told(count);
    workers.for_chunks(count, 1024, [&](std::size_t begin, std::size_t end) {
        Teller teller(points, positions, point, hanging);
        for (std::size_t k = begin; k < end; ++k) told[k] = teller.tell(asked.vertex[k], k % of_cells == 0);
    });
    for (const Told& each : told) {
        asked.star.push_back(each.star);
        asked.links.push_back(each.links);
    }
    const auto of_solid = static_cast<std::size_t>(std::ranges::count_if(told, &Told::thick));
    asked.fill_solid = 2 * of_solid * of_cells > count;
    asked.area = asked.fill_solid ? volumes_of(told) : areas_of(told);
    return asked;
}

} // namespace knead

#include "view/visibility.h"

#include "base/require.h"
#include "base/types.h"
#include "view/projector.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>

namespace knead {

namespace {

constexpr std::size_t grain = 16384;       // points a chunk
constexpr double spacings_a_cell = 3;      // nine points of an even cloud, five of a random one
constexpr double finest_cell = 2;          // pixels
constexpr double coarsest_cell = 1.0 / 16; // of the viewport's height
constexpr double tolerance_spacings = 2;   // noise, and the curvature within a cell
constexpr double steepest = 8;             // slope of a surface that is still followed: 83°
constexpr double steepest_edge = 2;        // of both sides of a ridge or a valley
constexpr std::size_t asked_for_depth = 4096;
constexpr float nothing = std::numeric_limits<float>::infinity();

struct Cells {
    int columns, rows;
    double per_cell;

    // Of a pixel; no_index outside the viewport.
    Index at(double x, double y) const {
        const double column = x * per_cell;
        const double row = y * per_cell;
        if (!(column >= 0 && column < columns && row >= 0 && row < rows)) return no_index;
        return static_cast<Index>(row) * static_cast<Index>(columns) + static_cast<Index>(column);
    }
};

// A depth that most of what is in the viewport lies behind: a quarter of it is nearer. Cells are as wide as
// the spacing looks there. (The nearest point of all may touch the eye.)
double near_depth(const Projector& projector, std::span<const float> positions) {
    const std::size_t count = positions.size() / 3;
    const std::size_t step = std::max<std::size_t>(1, count / asked_for_depth);
    std::vector<double> depths;
    for (std::size_t i = 0; i < count; i += step) {
        const Projector::Seen seen = projector(positions.data() + 3 * i);
        const bool in_view = seen.x >= 0 && seen.x < 2 * projector.half_width && seen.y >= 0 &&
                             seen.y < 2 * projector.half_height;
        if (in_view && projector.in_front(seen.depth)) depths.push_back(seen.depth);
    }
    if (depths.empty()) return projector.reference;
    const auto quarter = depths.begin() + static_cast<std::ptrdiff_t>(depths.size() / 4);
    std::ranges::nth_element(depths, quarter);
    return *quarter;
}

void lower(float& least, float value) {
    const std::atomic_ref<float> cell(least);
    float known = cell.load(std::memory_order_relaxed);
    while (value < known && !cell.compare_exchange_weak(known, value, std::memory_order_relaxed)) {
    }
}

// What lies that many cells away; nothing beyond the edge.
struct Neighborhood {
    const std::vector<float>& depth;
    int columns, rows;

    float at(int column, int row) const {
        if (column < 0 || column >= columns || row < 0 || row >= rows) return nothing;
        return depth[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) +
                     static_cast<std::size_t>(column)];
    }
};

// Half of the directions; the others are opposite.
constexpr std::array<std::array<int, 2>, 4> directions{{{1, 0}, {0, 1}, {1, 1}, {1, -1}}};

// Closes holes of a cell: what lies between two cells of a nearer surface belongs to it.
std::vector<float> closed(const std::vector<float>& depth, int columns, int rows, Workers& workers) {
    const Neighborhood around{depth, columns, rows};
    std::vector<float> result(depth.size());
    workers.for_each(static_cast<std::size_t>(rows), 16, [&](std::size_t r) {
        const int row = static_cast<int>(r);
        for (int column = 0; column < columns; ++column) {
            float here = around.at(column, row);
            for (const auto& [x, y] : directions)
                here =
                    std::min(here, std::max(around.at(column + x, row + y), around.at(column - x, row - y)));
            result[r * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column)] = here;
        }
    });
    return result;
}

// How far a surface that is at its nearest `here` may fall off within the cell. On a plane the cells two away
// on either side differ from it by at least as much as the cell spans, in one of the four directions. Where
// the surface ends it is taken to go on as it came; beyond a silhouette it does not, so the nearer side of
// the two decides.
double fall_within(const Neighborhood& around, int column, int row, double width) {
    const double here = double{around.at(column, row)};
    double fall = 0;
    for (const auto& [x, y] : directions) {
        const double a = double{around.at(column + 2 * x, row + 2 * y)} - here;
        const double b = double{around.at(column - 2 * x, row - 2 * y)} - here;
        const double least = std::min(std::abs(a), std::abs(b)); // infinite with nothing on either side
        const bool one_slope = (a < 0) != (b < 0) || std::isinf(a) || std::isinf(b);
        if (!std::isinf(least))
            fall = std::max(fall, std::min(least, (one_slope ? steepest : steepest_edge) * width));
    }
    return fall;
}

// fall_within() of every cell, and of those around it where that is more: in a corner of a surface there is
// too little of it to tell how steep it is.
std::vector<float> limits(const VisibleSurface& surface, const Projector& projector, Workers& workers) {
    const Neighborhood around{surface.depth, surface.columns, surface.rows};
    const auto columns = static_cast<std::size_t>(surface.columns);
    const auto rows = static_cast<std::size_t>(surface.rows);
    std::vector<float> falls(surface.depth.size(), 0);
    workers.for_each(rows, 16, [&](std::size_t row) {
        for (std::size_t column = 0; column < columns; ++column) {
            const double here = double{surface.depth[row * columns + column]};
            if (std::isinf(here)) continue;
            falls[row * columns + column] =
                static_cast<float>(fall_within(around, static_cast<int>(column), static_cast<int>(row),
                                               surface.cell * projector.pixel_size(here)));
        }
    });
    std::vector<float> result(surface.depth.size(), nothing);
    workers.for_each(rows, 16, [&](std::size_t row) {
        for (std::size_t column = 0; column < columns; ++column) {
            float fall = 0;
            for (std::size_t r = row - std::min<std::size_t>(row, 1); r <= std::min(row + 1, rows - 1); ++r)
                for (std::size_t c = column - std::min<std::size_t>(column, 1);
                     c <= std::min(column + 1, columns - 1); ++c)
                    fall = std::max(fall, falls[r * columns + c]);
            result[row * columns + column] =
                surface.depth[row * columns + column] + fall + static_cast<float>(surface.tolerance);
        }
    });
    return result;
}

} // namespace

VisibleSurface visible_surface(const Camera& camera, Viewport viewport, std::span<const float> positions,
                               std::span<const std::uint8_t> hidden, double spacing, Workers& workers) {
    require(hidden.empty() || hidden.size() * 3 == positions.size(), "one byte a point, or none");
    const Projector projector(camera, viewport);
    VisibleSurface surface;
    const double pixels = spacing / projector.pixel_size(near_depth(projector, positions));
    surface.cell = std::clamp(spacings_a_cell * pixels, finest_cell,
                              std::max(finest_cell, coarsest_cell * 2 * projector.half_height));
    surface.columns = static_cast<int>(std::ceil(2 * projector.half_width / surface.cell));
    surface.rows = static_cast<int>(std::ceil(2 * projector.half_height / surface.cell));
    surface.tolerance = tolerance_spacings * spacing;
    surface.depth.assign(static_cast<std::size_t>(surface.columns) * static_cast<std::size_t>(surface.rows),
                         nothing);
    const Cells cells{surface.columns, surface.rows, 1 / surface.cell};
    workers.for_chunks(positions.size() / 3, grain, [&](std::size_t begin, std::size_t end) {
        project_each(projector, positions.data(), begin, end,
                     [&](std::size_t i, const Projector::Seen& seen) {
                         if (!projector.in_front(seen.depth) || (!hidden.empty() && hidden[i] != 0)) return;
                         const Index cell = cells.at(seen.x, seen.y);
                         if (cell != no_index) lower(surface.depth[cell], static_cast<float>(seen.depth));
                     });
    });
    for (int pass = 0; pass < 2; ++pass)
        surface.depth = closed(surface.depth, surface.columns, surface.rows, workers);
    surface.limit = limits(surface, projector, workers);
    return surface;
}

void keep_visible(const Camera& camera, Viewport viewport, std::span<const float> positions,
                  const VisibleSurface& surface, std::span<std::uint8_t> inside, Workers& workers) {
    require(inside.size() * 3 == positions.size(), "one byte a point");
    const Projector projector(camera, viewport);
    const Cells cells{surface.columns, surface.rows, 1 / surface.cell};
    workers.for_chunks(inside.size(), grain, [&](std::size_t begin, std::size_t end) {
        project_each(projector, positions.data(), begin, end,
                     [&](std::size_t i, const Projector::Seen& seen) {
                         const Index cell = cells.at(seen.x, seen.y);
                         const float limit = cell == no_index ? -nothing : surface.limit[cell];
                         inside[i] &= static_cast<std::uint8_t>(projector.in_front(seen.depth) &
                                                                (static_cast<float>(seen.depth) <= limit));
                     });
    });
}

} // namespace knead

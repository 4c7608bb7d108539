#include "view/region_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace knead {

namespace {

// A region larger than the screen gets larger cells rather than more of them.
constexpr double most_cells = 4e6;
// Room for rounding around everything that is decided for a whole cell.
constexpr double slack = 1e-3; // of a cell

bool is_finite(glm::dvec2 p) {
    return std::isfinite(p.x) && std::isfinite(p.y);
}

// Whether a ray to the right of the pixel crosses the edge: the even-odd rule counts these.
bool crosses(glm::dvec2 from, glm::dvec2 to, glm::dvec2 pixel) {
    return (from.y > pixel.y) != (to.y > pixel.y) &&
           pixel.x < (to.x - from.x) * (pixel.y - from.y) / (to.y - from.y) + from.x;
}

double squared_distance(glm::dvec2 pixel, glm::dvec2 from, glm::dvec2 to) {
    const glm::dvec2 way = to - from;
    const double squared = glm::dot(way, way);
    const double along = squared > 0 ? std::clamp(glm::dot(pixel - from, way) / squared, 0.0, 1.0) : 0.0;
    const glm::dvec2 apart = pixel - from - along * way;
    return glm::dot(apart, apart);
}

// The corners of the polygon or stroke, none if they enclose nothing.
std::span<const glm::dvec2> corners_of(const ScreenRegion& region) {
    if (const auto* polygon = std::get_if<ScreenPolygon>(&region)) {
        if (polygon->corners.size() >= 3 && std::ranges::all_of(polygon->corners, is_finite))
            return polygon->corners;
    } else if (const auto* stroke = std::get_if<ScreenStroke>(&region)) {
        if (stroke->radius >= 0 && std::ranges::all_of(stroke->path, is_finite)) return stroke->path;
    }
    return {};
}

} // namespace

bool contains(const ScreenRegion& region, glm::dvec2 pixel) {
    if (const auto* box = std::get_if<ScreenBox>(&region)) {
        const glm::dvec2 lowest = glm::min(box->corner, box->opposite);
        const glm::dvec2 highest = glm::max(box->corner, box->opposite);
        return pixel.x >= lowest.x && pixel.x <= highest.x && pixel.y >= lowest.y && pixel.y <= highest.y;
    }
    const std::span<const glm::dvec2> corners = corners_of(region);
    if (corners.empty() || !is_finite(pixel)) return false;
    if (const auto* stroke = std::get_if<ScreenStroke>(&region)) {
        double nearest = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < corners.size(); ++i)
            nearest = std::min(nearest, squared_distance(pixel, corners[i == 0 ? 0 : i - 1], corners[i]));
        return nearest <= stroke->radius * stroke->radius;
    }
    bool odd = false;
    for (std::size_t i = 0; i < corners.size(); ++i)
        odd ^= crosses(corners[(i == 0 ? corners.size() : i) - 1], corners[i], pixel);
    return odd;
}

RegionGrid::RegionGrid(const ScreenRegion& region) {
    const std::span<const glm::dvec2> corners = corners_of(region);
    if (corners.empty()) return;
    glm::dvec2 lowest = corners[0];
    glm::dvec2 highest = corners[0];
    std::vector<Edge> edges;
    const auto* stroke = std::get_if<ScreenStroke>(&region);
    for (std::size_t i = 0; i < corners.size(); ++i) {
        lowest = glm::min(lowest, corners[i]);
        highest = glm::max(highest, corners[i]);
        const std::size_t before = i > 0 ? i - 1 : stroke ? 0 : corners.size() - 1;
        edges.push_back({corners[before], corners[i]});
    }
    stroke_ = stroke != nullptr;
    radius_ = stroke ? stroke->radius : 0;
    cover(lowest - radius_, highest + radius_);
    sort_into_rows(edges, radius_);
    if (stroke_)
        rasterize_stroke();
    else
        rasterize_polygon();
}

// Lays cells over the box, with two to spare on every side: the outer ones touch no edge.
void RegionGrid::cover(glm::dvec2 lowest, glm::dvec2 highest) {
    const glm::dvec2 size = highest - lowest;
    // Strokes are tested cell by cell, so they get coarser ones.
    cell_ = std::max(stroke_ ? 2.0 : 1.0, std::sqrt(size.x * size.y / most_cells));
    cell_ = std::max(cell_, std::max(size.x, size.y) / most_cells);
    per_cell_ = 1 / cell_;
    left_ = lowest.x - 2 * cell_;
    top_ = lowest.y - 2 * cell_;
    columns_ = static_cast<std::size_t>(std::ceil(size.x * per_cell_)) + 4;
    rows_ = static_cast<std::size_t>(std::ceil(size.y * per_cell_)) + 4;
    last_column_ = static_cast<double>(columns_ - 1);
    last_row_ = static_cast<double>(rows_ - 1);
    cells_.assign(columns_ * rows_, outside);
}

void RegionGrid::sort_into_rows(std::span<const Edge> edges, double reach) {
    const auto row_of = [&](double y) { return place((y - top_) * per_cell_, last_row_); };
    const auto for_rows = [&](const Edge& edge, auto&& visit) {
        const double room = reach + slack * cell_;
        const std::size_t last = row_of(std::max(edge.from.y, edge.to.y) + room);
        for (std::size_t r = row_of(std::min(edge.from.y, edge.to.y) - room); r <= last; ++r) visit(r);
    };
    first_.assign(rows_ + 1, 0);
    for (const Edge& edge : edges) for_rows(edge, [&](std::size_t r) { ++first_[r + 1]; });
    for (std::size_t r = 1; r < first_.size(); ++r) first_[r] += first_[r - 1];
    edges_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (const Edge& edge : edges) for_rows(edge, [&](std::size_t r) { edges_[next[r]++] = edge; });
}

// Cells that an edge touches are to be asked; runs of others take the verdict of their first one's middle.
void RegionGrid::rasterize_polygon() {
    const double room = slack * cell_;
    const auto column_of = [&](double x) { return place((x - left_) * per_cell_, last_column_); };
    for (std::size_t r = 0; r < rows_; ++r) {
        std::uint8_t* row = cells_.data() + r * columns_;
        const double above = top_ + static_cast<double>(r) * cell_ - room;
        const double below = above + cell_ + 2 * room;
        for (const Edge& edge : edges_of(r)) {
            // The part of the edge within the row.
            const glm::dvec2 way = edge.to - edge.from;
            double from = 0;
            double to = 1;
            if (std::abs(way.y) > room) {
                const double a = (above - edge.from.y) / way.y;
                const double b = (below - edge.from.y) / way.y;
                from = std::clamp(std::min(a, b), 0.0, 1.0);
                to = std::clamp(std::max(a, b), 0.0, 1.0);
            }
            const double x0 = edge.from.x + from * way.x;
            const double x1 = edge.from.x + to * way.x;
            const std::size_t last = column_of(std::max(x0, x1) + room);
            for (std::size_t c = column_of(std::min(x0, x1) - room); c <= last; ++c) row[c] = ask;
        }
        std::uint8_t verdict = ask;
        for (std::size_t c = 0; c < columns_; ++c) {
            if (row[c] != ask) {
                const glm::dvec2 middle =
                    glm::dvec2(left_, top_) +
                    cell_ * (glm::dvec2(static_cast<double>(c), static_cast<double>(r)) + 0.5);
                if (verdict == ask) verdict = contains_exactly(r, middle) ? inside : outside;
                row[c] = verdict;
            } else {
                verdict = ask;
            }
        }
    }
}

// Cells wholly within the radius of one segment are inside; those that only reach into it are to be asked.
void RegionGrid::rasterize_stroke() {
    const double half = (std::sqrt(0.5) + slack) * cell_; // from a cell's middle to its corners
    const double surely = radius_ - half;
    const double perhaps = radius_ + half;
    for (std::size_t r = 0; r < rows_; ++r) {
        std::uint8_t* row = cells_.data() + r * columns_;
        const double y = top_ + (static_cast<double>(r) + 0.5) * cell_;
        for (const Edge& edge : edges_of(r)) {
            const auto column_of = [&](double x) { return place((x - left_) * per_cell_, last_column_); };
            const std::size_t last = column_of(std::max(edge.from.x, edge.to.x) + perhaps);
            for (std::size_t c = column_of(std::min(edge.from.x, edge.to.x) - perhaps); c <= last; ++c) {
                if (row[c] == inside) continue;
                const double x = left_ + (static_cast<double>(c) + 0.5) * cell_;
                const double squared = squared_distance({x, y}, edge.from, edge.to);
                if (surely > 0 && squared < surely * surely)
                    row[c] = inside;
                else if (squared <= perhaps * perhaps)
                    row[c] = ask;
            }
        }
    }
}

bool RegionGrid::contains_exactly(std::size_t row, glm::dvec2 pixel) const {
    if (stroke_) {
        const double reach = radius_ + slack * cell_;
        return std::ranges::any_of(edges_of(row), [&](const Edge& edge) {
            if (pixel.x < std::min(edge.from.x, edge.to.x) - reach) return false; // to spare the division
            if (pixel.x > std::max(edge.from.x, edge.to.x) + reach) return false;
            return squared_distance(pixel, edge.from, edge.to) <= radius_ * radius_;
        });
    }
    bool odd = false;
    for (const Edge& edge : edges_of(row)) odd ^= crosses(edge.from, edge.to, pixel);
    return odd;
}

} // namespace knead

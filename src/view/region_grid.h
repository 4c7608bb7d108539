#pragma once
// A polygon or a brush stroke made ready to be asked about millions of pixels: a grid of cells that are all
// inside or all outside, and only in the cells between the exact test, against the edges of their row.

#include "view/screen_region.h"

#include <cstdint>
#include <span>
#include <vector>

namespace knead {

class RegionGrid {
public:
    // Of a polygon or a stroke; boxes need none.
    explicit RegionGrid(const ScreenRegion& region);

    // The same as contains(region, {x, y}) for every pixel, also one that is not a number. Pixels outside the
    // grid count to its border, which is outside the region: a branch for each would cost more than all the
    // rest.
    bool contains(double x, double y) const {
        const std::size_t row = place((y - top_) * per_cell_, last_row_);
        const std::size_t column = place((x - left_) * per_cell_, last_column_);
        const std::uint8_t verdict = cells_[row * columns_ + column];
        return verdict == ask ? contains_exactly(row, {x, y}) : verdict == inside;
    }

private:
    static constexpr std::uint8_t outside = 0, inside = 1, ask = 2;

    static std::size_t place(double cell, double last) {
        cell = cell > 0 ? cell : 0; // also where it is not a number
        return static_cast<std::size_t>(static_cast<std::int64_t>(cell < last ? cell : last));
    }

    struct Edge {
        glm::dvec2 from, to;
    };

    void cover(glm::dvec2 lowest, glm::dvec2 highest);
    void sort_into_rows(std::span<const Edge> edges, double reach);
    void rasterize_polygon();
    void rasterize_stroke();
    bool contains_exactly(std::size_t row, glm::dvec2 pixel) const;
    std::span<const Edge> edges_of(std::size_t row) const {
        return {edges_.data() + first_[row], first_[row + 1] - first_[row]};
    }

    bool stroke_ = false;
    double radius_ = 0; // of a stroke
    double left_ = 0, top_ = 0;
    double cell_ = 1, per_cell_ = 1; // pixels, and its inverse
    std::size_t columns_ = 1, rows_ = 1;
    double last_column_ = 0, last_row_ = 0;
    std::vector<std::uint8_t> cells_{outside};
    std::vector<Edge> edges_; // that reach into row r: first_[r] … first_[r + 1] - 1
    std::vector<std::size_t> first_{0, 0};
};

} // namespace knead

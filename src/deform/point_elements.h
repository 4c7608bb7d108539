#pragma once
// What one point between few samples adds to their energy: the bodies that move it, as finite elements, with
// their gradients along the surface. point_energy.h says what for.

#include "deform/fours.h"
#include "deform/point_energy.h"

#include <cstddef>
#include <vector>

namespace knead {

// A body at a vertex.
struct Element {
    Four gradient = {};  // g, of its weight
    Columns arms;        // H
    Four corrected = {}; // ĝ, of its share in the turns
    double share = 0;    // v
};

// All that one vertex adds.
struct Contribution {
    Columns along;        // P
    double measure = 0;   // ω
    double dimension = 0; // tr P
    std::vector<Index> body;
    std::vector<Element> element; // of each body
};

// Finds one after another, in the same memory.
class ContributionFinder {
public:
    explicit ContributionFinder(const PointsBetween& between);

    // What a vertex adds that does not hang, until the next is asked for. Nothing where it has no elements.
    const Contribution& find(Index vertex);

private:
    std::size_t place_of(Index body);
    double area_of_links(Index vertex) const;
    Mat3d add_gradients(Index vertex, const Vec3d& position, const Mat3d& inverse);
    void add_growths(Index vertex, const Vec3d& position, double squares);

    const PointsBetween& between_;
    std::vector<Index> row_;   // neighbours of the vertex that do not hang
    std::vector<Index> place_; // of each body: of its element; no_index without one
    Contribution found_;
};

} // namespace knead

#pragma once
// The Voronoi cell of a vertex on the surface around it.

#include "base/types.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace knead {

struct Cell {
    double area = 0;
    // How far the points around are from being a surface: what their spread across the plane that fits them
    // best is of the widest along it, and the other one along it of the widest. Near 0 and near 1 on an even
    // surface; 0 and 0 on a line.
    double thickness = 1, width = 0;
    // The mean square of the ways to them.
    double square_way = 0;
    // How far its farthest corner is from the vertex; infinitely where nothing bounds the cell on some side.
    double reach = 0;
};

// Finds one cell after another, in the same memory. `points`: the graph of the vertices; `positions`: 3
// floats a point, of which `point` names one for each vertex; `hanging`: of each vertex 1 for an outlier,
// which is not there; empty without any. All must outlive this.
//
// The cells of all points divide a surface without gaps or overlaps, however irregularly they lie on it: so
// they tell how much of it each stands for, which distances to neighbours do not. (Of points that were thrown
// at random the six nearest are nearer, on the mean, than of as many that keep apart.)
class CellFinder {
public:
    CellFinder(const Graph& points, std::span<const float> positions, const Numbering& point,
               std::span<const std::uint8_t> hanging)
        : points_(points), positions_(positions), point_(point), hanging_(hanging) {}

    // Of a vertex that does not hang: in the plane that fits best what is up to two links away, of the
    // bisectors with all of that, and with what is one link farther where it may have a say; and within a
    // square as large as what is around. Nothing where there are fewer than three points around.
    Cell find(Index vertex);

    // The area of the cell found last, if there were the images of all that is around mirrored at the vertex,
    // too: on a rim it is then as large as one inside, of which the part counts that the surface goes on in.
    double mirrored();

private:
    void gather(Index vertex);
    void flatten(Cell& cell);
    void cut_by_farther(Index vertex);
    void cut(const Eigen::Vector2d& other); // leaves what is nearer to the vertex

    const Graph& points_;
    std::span<const float> positions_;
    const Numbering& point_;
    std::span<const std::uint8_t> hanging_;
    std::vector<std::pair<double, Index>> around_; // squared distances, and to which vertex
    std::vector<Vec3d> way_;                       // to these, nearest first
    Eigen::Matrix<double, 2, 3> axes_;             // of the plane
    std::vector<Eigen::Vector2d> in_plane_;        // the ways in it
    std::vector<Eigen::Vector2d> corner_, kept_;
    double square_reach_ = 0; // of the corners
};

} // namespace knead

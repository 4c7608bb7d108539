#pragma once
// How much of the surface the vertices stand for.

#include "base/workers.h"
#include "graph/chosen_vertices.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

// Some vertices, and what each stands for. All entries but `each` are told in what the weights of a vertex's
// links come to, Σ_j w_ij |e_ij|² (edge_weights.h), where points lie evenly: six times the surface. 0 for an
// outlier that hangs.
struct AskedVertices {
    std::vector<Index> vertex; // ascending
    std::vector<double> each;  // of each: for so many vertices it stands
    std::vector<double> area;  // of each: six times its cell (cell_area.h); below 0: was not asked for it
    std::vector<double> star;  // what the weights of its links would come to by themselves
    std::vector<double> links; // six times the mean of the links' squares, times the share c of directions
    bool all = true;           // were asked, and for their cells
    bool fill_solid = false;   // most lie throughout a volume, and areas are volumes
};

// Asks these vertices, and one of `of_cells` for its cell as well, which takes three times as long as all
// else. `points`: the graph of the vertices; `positions`: 3 floats a point, of which
// `point` names one for each vertex; `hanging`: of each vertex 1 for an outlier, which counts neither itself
// nor as a neighbour; empty without any. The same for any number of workers.
//
// Where a cell reaches far, at a border, it is the mirrored one that counts, by the share c of directions. On
// a line, and where the points around are thick, the area is what the star says. Where they are so for most
// that are asked, the cloud fills a solid; then it is a volume that each stands for: what the star says, a
// square of the spacing, times how far those around are from each other, over the median of that.
AskedVertices ask_vertices(const Graph& points, std::span<const float> positions, const Numbering& point,
                           std::span<const std::uint8_t> hanging, ChosenVertices chosen, std::size_t of_cells,
                           Workers& workers);

} // namespace knead

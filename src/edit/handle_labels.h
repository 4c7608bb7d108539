#pragma once
// Which handle holds which point.

#include "edit/handles.h"
#include "graph/vertex_labels.h"

#include <cstdint>
#include <vector>

namespace knead {

class Workers;
struct PointOrder;

// Who holds each ordered point (or vertex): a place in `handles`, `outside` for what lies outside the region
// of interest, no_index for free ones. A point in several handles belongs to the one declared last; handles
// beat the region.
struct HandleLabels {
    std::vector<Index> point;
    std::vector<Index> vertex; // that of its points which was declared last; free only if all of them are
    Index outside = 0;         // = the number of places

    // Of each block of rows_in_block vertices: 0 only where all of them and of their points are free, ...
    std::vector<std::uint8_t> held;
    // ... and 1 where a label changed since whoever looks for changes set that to 0.
    std::vector<std::uint8_t> changed;

    VertexLabels of_vertices() const { return {vertex, held}; }
};
// `handles`: as they are declared; at places where `points` is null there is none (edit/handle_slots.h).
// `labels`: none yet, or those of other handles of the same cloud; only what those held, or these hold, is
// looked at. Where no point's label changed, vertices keep theirs, whatever became of these since.
void label_points(const std::vector<Handle>& handles, const PointOrder& order, std::size_t file_points,
                  Workers& workers, HandleLabels& labels);

} // namespace knead

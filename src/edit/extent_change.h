#pragma once
// How much larger a shape's surface and volume became.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/point_order.h"

#include <optional>
#include <span>

namespace knead {

// As fractions of what they were: 0.1 is a tenth more.
struct ExtentChange {
    std::optional<double> area;   // of a surface; nothing for a solid
    std::optional<double> volume; // of a solid, or enclosed by a surface; nothing where none is enclosed, or
                                  // where without normals nobody can tell
};

// Each vertex stands for a piece of the surface or of the solid, in proportion to the mean square or cube of
// the lengths of its links, and the piece is changed by the determinant of the gradient of its links. A cloud
// is taken for a solid where most vertices have neighbours on all sides. What a surface encloses is found by
// the divergence theorem, and told if the normals of all pieces sum up to nothing, within 5 %, as they do on
// a closed one. `point` names one for each vertex; `opened` and `now`: 3 floats a point, in the order of
// computation; `normals` of the points when opened, outward or inward throughout, or empty.
ExtentChange extent_change(const Numbering& point, const Graph& graph, std::span<const float> opened,
                           std::span<const float> normals, std::span<const float> now, Workers& workers);

} // namespace knead

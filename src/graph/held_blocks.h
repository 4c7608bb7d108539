#pragma once
// What handles hold of a cloud, block by block of its vertices: where they reach to, and their borders.
//
// A handle that comes or goes changes few blocks of a large cloud, and only these are looked at again.

#include "base/workers.h"
#include "graph/csr.h"
#include "graph/neighbors.h"
#include "graph/vertex_labels.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace knead {

// A component that a handle reaches into.
struct HeldPart {
    Index label, component;
    bool operator==(const HeldPart&) const = default;
    bool operator<(const HeldPart& other) const {
        return std::pair(label, component) < std::pair(other.label, other.component);
    }
};

// A vertex of a handle that has a free neighbour.
struct BorderVertex {
    Index label, vertex;
};

// How many vertices a label holds, where they are, and how far apart.
struct HeldExtent {
    Index label = no_index;
    Index count = 0;
    Vec3d sum = Vec3d::Zero(); // of the positions, seen from the cloud's first vertex
    double squares = 0;        // of how far they are from there

    void add(const Vec3d& position);
    void add(const HeldExtent& other);
    double radius() const; // of the disc that is spread as much; at least one vertex
};

// Of rows_in_block vertices.
struct HeldBlock {
    std::vector<HeldPart> parts;       // ascending, each once
    std::vector<BorderVertex> borders; // by vertex, ascending
    std::vector<HeldExtent> extents;   // of each label, in no order
};

// Looks again at blocks whose labels changed, and at those with neighbours in them. `changed`: of each block,
// 0 where no label did; `positions`: 3 floats a vertex; `blocks`: empty, which has all of them looked at, or
// what this made of the labels before for the same graph, positions and components.
void find_held(const VertexLabels& labels, std::span<const std::uint8_t> changed, const Graph& graph,
               std::span<const float> positions, const Components& components, Workers& workers,
               std::vector<HeldBlock>& blocks);

} // namespace knead

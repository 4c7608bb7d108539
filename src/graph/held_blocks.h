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

// Of rows_in_block vertices.
struct HeldBlock {
    std::vector<HeldPart> parts;       // ascending, each once
    std::vector<BorderVertex> borders; // by vertex, ascending
};

// Looks again at blocks whose labels changed, and at those with neighbours in them. `changed`: of each block,
// 0 where no label did; `blocks`: empty, which has all of them looked at, or what this made of the labels
// before for the same graph and components.
void find_held(const VertexLabels& labels, std::span<const std::uint8_t> changed, const Graph& graph,
               const Components& components, Workers& workers, std::vector<HeldBlock>& blocks);

} // namespace knead

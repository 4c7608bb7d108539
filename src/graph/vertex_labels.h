#pragma once
// Who holds each vertex, as the stages read it that have to do with what is held alone.

#include "base/types.h"
#include "graph/influences.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace knead {

struct VertexLabels {
    std::span<const Index> label;       // of each vertex a number that tells handles apart; no_index: free
    std::span<const std::uint8_t> held; // of each block of rows_in_block vertices: 0 where all are free
};

// Whether a flag is set of a handle, by its label, in a list that may end early; of no_index none is.
inline bool is_set(const std::vector<bool>& of_handles, Index label) {
    return label < of_handles.size() && of_handles[label];
}

// Calls visit(v) for the vertices of begin … end that are held, ascending.
template<typename Visit>
void for_each_held(const VertexLabels& labels, std::size_t begin, std::size_t end, Visit&& visit) {
    for (std::size_t v = begin; v < end;) {
        const std::size_t block = v / rows_in_block;
        const std::size_t next = std::min(end, (block + 1) * rows_in_block);
        if (!labels.held[block]) v = next;
        for (; v < next; ++v)
            if (labels.label[v] != no_index) visit(static_cast<Index>(v));
    }
}

} // namespace knead

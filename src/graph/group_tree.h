#pragma once
// The nearest vertex that belongs to others.

#include "base/types.h"
#include "base/workers.h"

#include <limits>
#include <span>
#include <vector>

namespace knead {

// Vertices in groups, ready to be searched: a tree of boxes over runs of vertices, which are in Morton order
// and so lie close together. A box that holds nothing but the asker's own group is passed over whole, so a
// search costs little wherever the others are far.
struct GroupTree {
    std::span<const float> positions; // 3 floats a vertex
    std::span<const Index> group;     // of each vertex; no_index: it is never found

    struct Box {
        float lowest[3], highest[3];
        Index group; // of all in it that can be found; no_index: there are none
        bool mixed;  // whether they are of several groups; `group` is then one of them
    };
    std::vector<Box> boxes;   // box b holds boxes 2b + 1 and 2b + 2; the last `runs` hold vertices
    std::size_t runs = 0;     // a power of two
    std::size_t vertices = 0; // in a run; the last runs may hold fewer
};

// `positions` and `group` must outlive the tree, and stay as they are.
GroupTree group_tree(std::span<const float> positions, std::span<const Index> group, Workers& workers);

struct Neighbor {
    Index vertex = no_index; // there is none
    double distance = std::numeric_limits<double>::infinity();
};

// The vertex nearest to v, and no farther than `reach`, whose group is not that of v; of several as near the
// one of the lowest number. Where v has no group, that is any vertex that has one.
Neighbor nearest_of_others(const GroupTree& tree, std::size_t v, double reach);

// The nearest of those that are no farther than v reaches, and reach as far as v themselves. `reach`: of each
// vertex.
Neighbor nearest_within_both(const GroupTree& tree, std::size_t v, std::span<const float> reach);

} // namespace knead

#pragma once
// Places that handles keep while others come and go, so that what a pipeline made of them stays good.

#include "edit/handles.h"

#include <vector>

namespace knead {

// A list of handles with free places between them. Inside a pipeline a handle is told by its place: labels
// (graph/vertex_labels.h), motions and what floods carry are numbered so. Which places these are depends on
// what was there before; their order is that of the list, and nothing else may make a difference.
struct HandleSlots {
    std::vector<Handle> handles; // one a place; `points` is null where it is free
    std::vector<Index> slot;     // of each handle of the list, ascending
    std::vector<Index> handle;   // of each place: which of the list; no_index where it is free. One more: of
                                 // what lies outside a region of interest, the number of handles
};

// Makes them those of `list`. What the list begins and ends with as before keeps its places, and so does, as
// far as there are as many, what is between; what is more finds free ones, or all are spread anew. Where
// memory runs out nothing has changed.
void arrange(const std::vector<Handle>& list, HandleSlots& slots);

} // namespace knead

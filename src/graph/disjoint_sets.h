#pragma once
// Which of many belong together, as pairs of them are joined.

#include "base/types.h"

#include <algorithm>
#include <vector>

namespace knead {

// The root of what v belongs to. `parent`: of each its own number, to begin with.
inline Index find_root(std::vector<Index>& parent, Index v) {
    while (parent[v] != v) {
        parent[v] = parent[parent[v]];
        v = parent[v];
    }
    return v;
}

// Joins what the two belong to, and tells whether they were apart. The root is the lowest of those that
// belong together, whoever is joined first.
inline bool join(std::vector<Index>& parent, Index v, Index u) {
    const Index a = find_root(parent, v);
    const Index b = find_root(parent, u);
    if (a != b) parent[std::max(a, b)] = std::min(a, b);
    return a != b;
}

} // namespace knead

#pragma once
// Points that follow each other in the order of computation.

#include <cstddef>

namespace knead {

struct PointRange {
    std::size_t first = 0, end = 0; // `end` is the one after the last
};

} // namespace knead

#pragma once
// What repeated measurements say: the median, which one slow run does not move, and how far they spread.

#include <cstddef>
#include <vector>

namespace knead {

// In the unit of what was measured; all 0 where nothing was.
struct Summary {
    double median = 0; // of an even number: the mean of the two in the middle
    double lowest = 0;
    double highest = 0;
    std::size_t count = 0;
};

Summary summarize(std::vector<double> values);

// The median of `a` over that of `b`; 0 where nothing was measured of b.
double ratio(const Summary& a, const Summary& b);

} // namespace knead

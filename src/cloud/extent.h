#pragma once
// How large a cloud is, in a measure that neither turns with the axes, nor grows with one outlier, nor asks
// how densely which part was scanned.

#include <span>

namespace knead {

// s = √(12 tr Cov) of a body, but for the twentieth of it that is the farthest from its median: the diagonal
// of a box, where the body fills one. Stiffness β = α s² is told in it. `positions`: 3 floats a point, all
// finite, relative to any origin; `area`: of each how much of the body it stands for, >= 0, up to a factor
// that is the same for all (where all are 0, each as much as another). A point counts for at most 16 times
// the mean: a few that are far from everything make no body. In the unit of the positions; at least a tiny
// positive number, and 1 of nothing.
double cloud_size(std::span<const float> positions, std::span<const double> area);

} // namespace knead

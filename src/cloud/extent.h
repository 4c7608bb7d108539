#pragma once
// How large a cloud is, in a measure that neither turns with the axes nor grows with one outlier.

#include "cloud/point_cloud.h"

#include <span>

namespace knead {

class Workers;

// s = √(12 tr Cov) over the points but the 5 % farthest from their median: the diagonal of a box, where the
// points fill one evenly. Stiffness β = α s² is told in it. In the file's units; at least a tiny positive
// number. Points that are not finite do not count.
double cloud_size(const PointCloud& cloud, Workers& workers);
// The same of positions, 3n, relative to any origin. Give each once: a scanner that writes what it did not
// see to one place would make another cloud of it.
double cloud_size(std::span<const float> positions, Workers& workers);

} // namespace knead

#pragma once
// How large a cloud is, in a measure that neither turns with the axes nor grows with one outlier.

#include "cloud/point_cloud.h"

namespace knead {

class Workers;

// s = √(12 tr Cov) over the points but the 5 % farthest from their median: the diagonal of a box, where the
// points fill one evenly. Stiffness β = α s² is told in it. In the file's units; at least a tiny positive
// number.
double cloud_size(const PointCloud& cloud, Workers& workers);

} // namespace knead

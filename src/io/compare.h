#pragma once
// How far apart two clouds of the same points are.

#include "cloud/point_cloud.h"

#include <span>
#include <string>
#include <vector>

namespace knead {

// Distances point by point, in the file's units. A point that is not finite in either cloud, with the same
// values, counts as distance 0; one that is not finite otherwise cannot be compared.
struct Distances {
    double rms = 0;
    double p95 = 0; // 95 % of the points compared are this near or nearer
    double largest = 0;
    std::size_t largest_index = 0; // the first of the farthest points; 0 where nothing was compared
    std::size_t compared = 0;
    std::size_t incomparable = 0;
};

// Both clouds have the same number of points; their files' own coordinates are compared, in double.
Distances distances_between(const PointCloud& a, const PointCloud& b);

// The same for `cloud` posed: its coordinates are the file's own plus posed - rest, in double, as
// write_cloud() has them before it rounds. `positions` are 3n, relative to cloud.origin.
Distances distances_between(const PointCloud& cloud, std::span<const float> positions,
                            const PointCloud& other);

// Names of attributes, the coordinates left out, in the order of the cloud that has them.
struct AttributeDifferences {
    std::vector<std::string> differ; // in both, but not the same type and values
    std::vector<std::string> only_in_a;
    std::vector<std::string> only_in_b;

    bool none() const { return differ.empty() && only_in_a.empty() && only_in_b.empty(); }
};
AttributeDifferences attribute_differences(const PointCloud& a, const PointCloud& b);

} // namespace knead

#pragma once
// How far apart two clouds of the same points are.

#include "cloud/point_cloud.h"

#include <span>
#include <string>
#include <vector>

namespace knead {

// Distances point by point, in the file's units. Coordinates that are the same in both and not finite count
// as no distance; a point that is not finite otherwise cannot be compared.
struct Distances {
    double rms = 0;
    double p95 = 0; // 95 % of the points compared are this near or nearer
    double largest = 0;
    std::size_t largest_index = 0; // the first of the farthest points; 0 where nothing was compared
    std::size_t compared = 0;
    std::size_t incomparable = 0;
    std::size_t first_incomparable = 0; // of these
};

// Both clouds have the same number of points; their files' own coordinates are compared, in double.
Distances distances_between(const PointCloud& a, const PointCloud& b);

// The same for `cloud` posed: its coordinates are the file's own plus posed - rest, in double, as
// write_cloud() has them before it rounds; what rounding them to the types of `other` can explain does not
// count. `positions` are 3n, relative to cloud.origin.
Distances distances_between(const PointCloud& cloud, std::span<const float> positions,
                            const PointCloud& other);

// How far an attribute of one name differs.
struct AttributeDifference {
    std::string name;
    bool same_type = true;  // of the numbers, and of lists; else numbers are compared as double
    std::size_t points = 0; // that have another number, or another list
    double largest = 0;     // of the distances between numbers that are finite in both, item by item of lists
    std::size_t farthest_point = 0; // the first with that distance; 0 where there is none
};

// Attributes, the coordinates left out, in the order of the cloud that has them.
struct AttributeDifferences {
    std::vector<AttributeDifference> differ; // in both, but not with the same type and values
    std::vector<std::string> only_in_a;
    std::vector<std::string> only_in_b;

    bool none() const { return differ.empty() && only_in_a.empty() && only_in_b.empty(); }
};
// Both clouds have the same number of points.
AttributeDifferences attribute_differences(const PointCloud& a, const PointCloud& b);

} // namespace knead

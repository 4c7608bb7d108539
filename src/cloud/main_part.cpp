#include "cloud/main_part.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace knead {

namespace {

// So many points tell; of fewer than the first number a hundredth is none.
constexpr std::size_t fewest = 200, enough = 20'000;

constexpr double share_at_either_end = 0.01;

} // namespace

MainPart main_part_of(const PointCloud& cloud, std::size_t points) {
    MainPart part;
    if (points < fewest) return part;
    const std::size_t stride = std::max<std::size_t>(1, points / enough);
    Vec3d lowest, highest;
    for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const Attribute& column = cloud.attributes[cloud.coordinate_columns[static_cast<std::size_t>(axis)]];
        std::vector<double> values;
        values.reserve(points / stride + 1);
        for (std::size_t i = 0; i < points; i += stride) {
            const double value = value_at(column, i);
            if (std::abs(value) <= double{std::numeric_limits<float>::max()}) values.push_back(value);
        }
        if (values.size() < fewest) return part;
        const auto cut =
            static_cast<std::ptrdiff_t>(share_at_either_end * static_cast<double>(values.size()));
        std::nth_element(values.begin(), values.begin() + cut, values.end());
        lowest[axis] = values[static_cast<std::size_t>(cut)];
        std::nth_element(values.begin(), values.end() - 1 - cut, values.end());
        highest[axis] = *(values.end() - 1 - cut);
    }
    part.middle = 0.5 * lowest + 0.5 * highest;
    part.size = (highest - lowest).norm();
    return part;
}

} // namespace knead

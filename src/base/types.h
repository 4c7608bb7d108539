#pragma once
// The few vector names that every room shares.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>
#include <span>

namespace knead {

using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;
using Quatd = Eigen::Quaterniond;

// The number of a point, a graph vertex or a sample; clouds of up to 2^32 - 2 points.
using Index = std::uint32_t;

// What stands where there is no index.
inline constexpr Index no_index = ~Index{0};

// The i-th of positions, or of normals, that stand three floats after three floats.
inline Vec3d point_at(std::span<const float> positions, std::size_t i) {
    return Eigen::Map<const Vec3f>(positions.data() + 3 * i).cast<double>();
}

} // namespace knead

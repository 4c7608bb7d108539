#pragma once
// The few vector names that every room shares.

#include <Eigen/Core>
#include <Eigen/Geometry>

#include <cstddef>
#include <cstdint>

namespace knead {

using Vec3f = Eigen::Vector3f;
using Vec3d = Eigen::Vector3d;
using Mat3d = Eigen::Matrix3d;
using Quatd = Eigen::Quaterniond;

// The number of a point, a graph vertex or a sample; clouds of up to 2^32 - 2 points.
using Index = std::uint32_t;

// What stands where there is no index.
inline constexpr Index no_index = ~Index{0};

} // namespace knead

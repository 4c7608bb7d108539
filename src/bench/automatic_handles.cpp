#include "bench/automatic_handles.h"

#include <algorithm>
#include <array>
#include <numbers>

namespace knead {

namespace {

constexpr double handle_length = 0.15; // of the longest side

} // namespace

AutomaticHandles automatic_handles(const PointCloud& cloud) {
    const Bounds bounds = bounds_of(cloud);
    const Vec3d size = bounds.highest - bounds.lowest;
    std::array<int, 3> axes{0, 1, 2};
    std::ranges::stable_sort(axes, [&](int a, int b) { return size[a] > size[b]; });

    AutomaticHandles handles;
    handles.pivot = (bounds.lowest + bounds.highest) / 2;
    handles.axis = Vec3d::Unit(axes[1]);
    const int along = axes[0];
    const double low = bounds.lowest[along] + handle_length * size[along];
    const double high = bounds.highest[along] - handle_length * size[along];
    for (Index i = 0; i < cloud.size(); ++i) {
        if (!is_finite(cloud, i)) continue;
        const double place = cloud.file_position(i)[along];
        if (place <= low) handles.fixed.push_back(i);
        if (place >= high) handles.moving.push_back(i);
    }
    return handles;
}

HandlePose bent_by(const AutomaticHandles& handles, double degrees) {
    HandlePose pose;
    pose.rotate = Eigen::AngleAxisd(degrees * std::numbers::pi / 180, handles.axis);
    return pose;
}

HandleLine handle_line(const std::string& name, HandleRole role, const std::vector<Index>& points) {
    std::vector<IndexRange> ranges;
    for (const Index i : points) {
        if (!ranges.empty() && ranges.back().last + 1 == i)
            ranges.back().last = i;
        else
            ranges.push_back({i, i});
    }
    HandleLine line;
    line.name = name;
    line.role = role;
    line.points = std::move(ranges);
    return line;
}

} // namespace knead

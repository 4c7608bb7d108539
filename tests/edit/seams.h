#pragma once
// How far handles are torn from what is around them.

#include "edit/editing.h"

#include <cmath>

namespace knead::test {

// The largest stretch, as a logarithm, of the links that only one end of is held.
inline double widest_seam(const Desk& desk) {
    const Pipeline& pipeline = desk.pipeline();
    const std::vector<Index>& label = pipeline.labels().vertex;
    const PointOrder& order = pipeline.order();
    const auto length = [&](std::span<const float> shape, Index v, Index w) {
        return (at(shape, order.first_point[v]) - at(shape, order.first_point[w])).norm();
    };
    double widest = 0;
    for (Index v = 0; v < label.size(); ++v)
        for (const Index w : pipeline.graph().row(v)) {
            if (label[v] == no_index || label[w] != no_index) continue;
            const double was = length(pipeline.opened().positions, v, w);
            widest = std::max(widest, std::abs(std::log(length(pipeline.posed().positions, v, w) / was)));
        }
    return widest;
}

} // namespace knead::test

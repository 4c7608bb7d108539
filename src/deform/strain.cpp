#include "deform/strain.h"

#include <algorithm>

namespace knead {

Strain strain_of(const SampleSystem& system, const SampleState& state) {
    const SampleRest& rest = system.rest;
    std::vector<double> stretches;
    for (const Index i : system.free_sample)
        for (const Index j : rest.graph.row(i)) {
            const Vec3d edge = rest.position[j] - rest.position[i];
            const double length = edge.norm();
            if (!(length > 0)) continue;
            stretches.push_back((edge + state.displacement[j] - state.displacement[i]).norm() / length);
        }
    if (stretches.empty()) return {};
    const auto one_of_a_hundred = static_cast<std::ptrdiff_t>(stretches.size() / 100);
    const auto low = stretches.begin() + one_of_a_hundred;
    const auto high = stretches.end() - 1 - one_of_a_hundred;
    std::nth_element(stretches.begin(), low, stretches.end());
    const double shortest = *low;
    std::nth_element(stretches.begin(), high, stretches.end());
    return {*high, shortest};
}

} // namespace knead

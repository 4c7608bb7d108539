#include "deform/strain.h"

#include <algorithm>

namespace knead {

double strain_of(const SampleSystem& system, const SampleState& state) {
    const SampleRest& rest = system.rest;
    std::vector<double> stretches;
    for (const Index i : system.free_sample)
        for (const Index j : rest.graph.row(i)) {
            const Vec3d edge = rest.position[j] - rest.position[i];
            const double length = edge.norm();
            if (!(length > 0)) continue;
            stretches.push_back((edge + state.displacement[j] - state.displacement[i]).norm() / length);
        }
    if (stretches.empty()) return 1;
    const auto found =
        stretches.begin() + static_cast<std::ptrdiff_t>(stretches.size() - 1 - stretches.size() / 100);
    std::nth_element(stretches.begin(), found, stretches.end());
    return *found;
}

} // namespace knead

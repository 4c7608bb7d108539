#include "upsample/point_rotations.h"

#include "base/require.h"
#include "graph/balanced_weights.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t points_per_chunk = 8192;

Quatd mean_turn(const Influence& influence, std::span<const Quatd> turns) {
    const auto heaviest =
        std::ranges::max_element(influence.weight) - influence.weight.begin(); // the first of equals
    const Quatd& leader = turns[influence.motion[static_cast<std::size_t>(heaviest)]];
    Eigen::Vector4d sum = Eigen::Vector4d::Zero();
    for (std::size_t k = 0; k < influence.count; ++k) {
        const Quatd& turn = turns[influence.motion[k]];
        const double weight = static_cast<double>(influence.weight[k]);
        sum += (turn.dot(leader) < 0 ? -weight : weight) * turn.coeffs();
    }
    // A vertex that nothing moves has weights of 0.
    if (!(sum.squaredNorm() > 0)) return Quatd::Identity();
    Quatd mean;
    mean.coeffs() = sum.normalized();
    return mean;
}

} // namespace

std::vector<float> point_rotations(const UpsampleInput& input, std::span<const Quatd> turns,
                                   std::span<const float> before, Workers& workers) {
    const std::size_t points = input.mover.size();
    require(before.empty() || before.size() == 4 * points, "a turn before for every point, or none");
    std::vector<float> result(4 * points);
    workers.for_each(points, points_per_chunk, [&](std::size_t i) {
        float* const to = result.data() + 4 * i;
        Quatd turn = mean_turn(influence_of(*input.rows, input.weights, input.places, input.mover[i],
                                            point_at(input.positions, i)),
                               turns);
        if (!before.empty()) {
            // What does not turn any further keeps every bit.
            if (turn.w() == 1 && turn.vec().isZero(0)) return void(std::copy_n(before.data() + 4 * i, 4, to));
            const auto at = [&](std::size_t part) { return static_cast<double>(before[4 * i + part]); };
            turn = (turn * Quatd(at(0), at(1), at(2), at(3))).normalized();
        }
        to[0] = static_cast<float>(turn.w());
        to[1] = static_cast<float>(turn.x());
        to[2] = static_cast<float>(turn.y());
        to[3] = static_cast<float>(turn.z());
    });
    return result;
}

} // namespace knead

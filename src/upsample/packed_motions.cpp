#include "upsample/packed_motions.h"

namespace knead {

void pack_motions(std::span<const Motion> motions, InfluenceWeights weights, std::span<const Vec3d> places,
                  std::span<PackedMotion> packed) {
    const std::size_t with_place = weights == InfluenceWeights::paper ? 0 : places.size();
    for (std::size_t m = 0; m < motions.size(); ++m) {
        const float* const map = motions[m].map;
        const Vec3f c = m < with_place ? Vec3f(0.5F * places[m].cast<float>()) : Vec3f::Zero();
        auto& column = packed[m].column;
        for (std::size_t row = 0; row < 3; ++row) {
            const float* const from = map + 4 * row;
            for (std::size_t axis = 0; axis < 3; ++axis) column[axis][row] = from[axis];
            column[3][row] = from[3] + (from[0] * c[0] + from[1] * c[1] + from[2] * c[2]);
            column[row + 1][3] = c[row];
        }
        column[0][3] = 0.0F;
    }
}

} // namespace knead

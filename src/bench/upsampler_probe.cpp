#include "bench/upsampler_probe.h"

namespace knead {

void UpsamplerProbe::prepare(const UpsampleInput& input, std::size_t motions) {
    input_ = input;
    motions_.assign(motions, Motion{});
    inner_->prepare(input, motions);
}

std::span<const Index> UpsamplerProbe::run(std::span<const Motion> motions, std::span<float> positions,
                                           std::span<float> normals, Held /*held*/) {
    motions_.assign(motions.begin(), motions.end());
    return inner_->run(motions, positions, normals, Held::nothing);
}

std::size_t bytes_a_frame(const UpsampleInput& input) {
    const std::size_t floats = 2 * (input.positions.size() + input.normals.size());
    const std::size_t row_bytes = input.rows->are_wide() ? sizeof(WideRow) : sizeof(NarrowRow);
    return floats * sizeof(float) + input.mover.size_bytes() + input.rows->size() * row_bytes;
}

} // namespace knead

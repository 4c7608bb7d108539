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

std::size_t bytes_a_frame(const UpsamplerProbe& probe) {
    const UpsampleInput& input = probe.input();
    const std::size_t floats = 2 * (input.positions.size() + input.normals.size());
    return floats * sizeof(float) + probe.influence_bytes();
}

} // namespace knead

#include "bench/bare_pipeline.h"

#include <utility>

namespace knead {

std::shared_ptr<const std::vector<Index>> shared_points(std::vector<Index> points) {
    return std::make_shared<const std::vector<Index>>(std::move(points));
}

SampleState pose_from_rest(Pipeline& pipeline, const std::vector<HandleMotion>& motions,
                           unsigned iterations) {
    SampleState state = pipeline.rest_state();
    pipeline.follow_handles(motions, state);
    Acceleration acceleration;
    for (unsigned i = 0; i < iterations; ++i) pipeline.iterate(motions, state, acceleration);
    pipeline.upsample(motions, state);
    return state;
}

std::vector<bool> held_parts(const Pipeline& pipeline) {
    const Components& components = pipeline.components();
    const std::vector<Index>& label = pipeline.labels().vertex;
    std::vector<bool> held(components.size.size(), false);
    for (std::size_t v = 0; v < label.size(); ++v)
        if (label[v] != no_index) held[components.component[v]] = true;
    return held;
}

} // namespace knead

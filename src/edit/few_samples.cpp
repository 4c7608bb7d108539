#include "edit/few_samples.h"

#include "base/counts.h"

#include <algorithm>

namespace knead {

std::string words_about_few_samples(const Pipeline& pipeline) {
    constexpr std::size_t enough = 60, points_to_each = 8;
    const std::size_t all = pipeline.samples().size(), free = pipeline.system().moving_rows;
    if (free >= enough || 4 * free >= all) return {};
    const auto points = static_cast<std::size_t>(std::ranges::count(pipeline.labels().vertex, no_index));
    if (points < points_to_each * free) return {};
    return "only " + counted(free, "sample") + " of " + std::to_string(all) + (free == 1 ? " lies" : " lie") +
           " where the cloud can move, so its shape there is coarse; with more \"samples\" more of it shows";
}

} // namespace knead

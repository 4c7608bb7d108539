#include "graph/influences.h"

#include <numeric>

namespace knead {

Influence influence_of(const InfluenceRows& rows, InfluenceWeights weights, Index number) {
    Influence result{};
    if (number >= rows.size()) {
        result.motion[0] = static_cast<Index>(number - rows.size());
        result.weight[0] = 1;
        result.count = 1;
        return result;
    }
    const WideRow row = rows[number];
    result.count = row.count();
    const auto weight = weights_of(row, rows.first_handle, weights);
    const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (std::size_t k = 0; k < result.count; ++k) {
        result.motion[k] = row.sample[k];
        result.weight[k] = static_cast<float>(static_cast<double>(weight[k]) / sum);
    }
    return result;
}

} // namespace knead

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
    return influence_of(rows[number], rows.first_handle, weights);
}

Influence influence_of(const WideRow& row, Index first_handle, InfluenceWeights weights) {
    Influence result{};
    result.count = row.count();
    const auto weight = weights_of(row, first_handle, weights);
    const double sum = std::accumulate(weight.begin(), weight.end(), 0.0);
    for (std::size_t k = 0; k < result.count; ++k) {
        result.motion[k] = row.sample[k];
        result.weight[k] = static_cast<float>(static_cast<double>(weight[k]) / sum);
    }
    return result;
}

} // namespace knead

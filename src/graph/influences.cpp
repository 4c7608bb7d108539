#include "graph/influences.h"

#include <numeric>
#include <utility>

namespace knead {

std::size_t InfluenceRows::size() const {
    return std::visit([](const auto& kind) { return kind.size(); }, rows);
}

WideRow InfluenceRows::operator[](std::size_t v) const {
    if (const auto* wide = std::get_if<std::vector<WideRow>>(&rows)) return (*wide)[v];
    return widened(std::get<std::vector<NarrowRow>>(rows)[v]);
}

std::vector<WideRow> rows_at(const InfluenceRows& rows, std::span<const Index> vertices) {
    std::vector<WideRow> result;
    result.reserve(vertices.size());
    for (const Index v : vertices) result.push_back(rows[v]);
    return result;
}

WideRow widened(const NarrowRow& row) {
    const auto wide = [](std::uint16_t number) {
        return number == NarrowRow::none ? WideRow::none : Index{number};
    };
    WideRow result;
    std::ranges::transform(row.sample, result.sample.begin(), wide);
    std::ranges::transform(row.distance, result.distance.begin(), wide);
    return result;
}

void widen(InfluenceRows& rows) {
    const auto* narrow = std::get_if<std::vector<NarrowRow>>(&rows.rows);
    if (!narrow) return;
    std::vector<WideRow> wide(narrow->size());
    std::ranges::transform(*narrow, wide.begin(), [](const NarrowRow& row) { return widened(row); });
    rows.rows = std::move(wide);
}

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

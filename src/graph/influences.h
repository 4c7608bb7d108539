#pragma once
// Which samples and handles move a point, and how much each: the w_s of Equations (4) and (5).
//
// What is kept are the nearest of every vertex and how far they are along the surface. The weights are
// computed from that where they are used: their kind is nothing that a row would be made again for.

#include "base/types.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>
#include <variant>
#include <vector>

namespace knead {

inline constexpr std::size_t influences_per_row = 8; // K of the paper

// Rows by blocks of consecutive ones: which of them changed is told by block.
inline constexpr std::size_t rows_in_block = 256;
constexpr std::size_t blocks_of_rows(std::size_t rows) {
    return (rows + rows_in_block - 1) / rows_in_block;
}
struct RowRange {
    std::size_t begin = 0, end = 0;
};
// Which rows a block has, of so many in all.
constexpr RowRange rows_of_block(std::size_t block, std::size_t rows) {
    return {block * rows_in_block, std::min((block + 1) * rows_in_block, rows)};
}

// The K nearest samples and handles of a vertex, by (distance, number), or fewer `places` of them. A vertex
// whose component has fewer keeps the last places empty: `none` for sample and distance.
template<typename Number, std::size_t places = influences_per_row>
struct alignas(2 * places * sizeof(Number)) SampleRow { // within a cache line
    static constexpr Number none = std::numeric_limits<Number>::max();

    std::array<Number, places> sample;
    std::array<Number, places> distance; // in levels, see flood.h

    std::size_t count() const {
        return static_cast<std::size_t>(std::ranges::find(sample, none) - sample.begin());
    }
};
using NarrowRow = SampleRow<std::uint16_t>;
using WideRow = SampleRow<Index>;

// The same as a wide row.
template<std::size_t places>
const SampleRow<Index, places>& widened(const SampleRow<Index, places>& row) {
    return row;
}
template<std::size_t places>
SampleRow<Index, places> widened(const SampleRow<std::uint16_t, places>& row) {
    using Narrow = SampleRow<std::uint16_t, places>;
    SampleRow<Index, places> result;
    const auto wide = [](std::uint16_t number) { return number == Narrow::none ? no_index : Index{number}; };
    std::ranges::transform(row.sample, result.sample.begin(), wide);
    std::ranges::transform(row.distance, result.distance.begin(), wide);
    return result;
}

// One row a vertex. They are narrow where all numbers and distances are below 65,535, which halves what a
// flood and a frame have to move, else wide; the flood decides. What they mean is the same.
template<std::size_t places>
struct NearestRows {
    using Narrow = SampleRow<std::uint16_t, places>;
    using Wide = SampleRow<Index, places>;

    std::variant<std::vector<Narrow>, std::vector<Wide>> rows;

    std::size_t size() const {
        return std::visit([](const auto& kind) { return kind.size(); }, rows);
    }
    bool are_wide() const { return rows.index() == 1; }

    // Row v as a wide one, whichever it is.
    Wide operator[](std::size_t v) const {
        return std::visit([v](const auto& kind) -> Wide { return widened(kind[v]); }, rows);
    }
};
using TerritoryRows = NearestRows<1>; // of the nearest sample alone
struct InfluenceRows : NearestRows<influences_per_row> {
    // Numbers from here on are not samples but handles, which start from all along their borders.
    Index first_handle = no_index;
};

// Makes the rows wide if they are narrow.
template<std::size_t places>
void widen(NearestRows<places>& nearest) {
    using Rows = NearestRows<places>;
    const auto* narrow = std::get_if<std::vector<typename Rows::Narrow>>(&nearest.rows);
    if (!narrow) return;
    std::vector<typename Rows::Wide> wide;
    wide.reserve(narrow->size());
    for (const auto& row : *narrow) wide.push_back(widened(row));
    nearest.rows = std::move(wide);
}

// Those of these vertices, as wide ones.
template<std::size_t places>
std::vector<SampleRow<Index, places>> rows_at(const NearestRows<places>& nearest,
                                              std::span<const Index> vertices) {
    std::vector<SampleRow<Index, places>> rows;
    rows.reserve(vertices.size());
    for (const Index v : vertices) rows.push_back(nearest[v]);
    return rows;
}

// How a sample's weight falls with its distance d from the point.
enum class InfluenceWeights {
    smooth, // (1 - d/d_max)² with d_max the farthest of a full row: nothing jumps where the set of the
            // nearest changes; where the row is not full the set is the same everywhere, and d_max twice as
            // far; of a handle times handle_reach · farthest/d: nothing jumps at its border, either
    paper,  // 1/d²
};

// So far from its border, as a share of the farthest, a handle weighs what a sample there would; nearer by it
// more, and without bound. Less leaves a seam of stretched links along the border, more is stiff beside it
// and bends farther out (knead evaluate, the unevenness of links with 50 to 200 samples).
inline constexpr float handle_reach = 0.15F;

// By how much a handle weighs more than a sample as far away.
template<typename Number>
float growth_of_handle(Number distance, Number farthest) {
    return handle_reach * static_cast<float>(farthest) / static_cast<float>(distance);
}

// The place of a row that is all there is at d = 0: of the paper's weights whichever is there, of smooth ones
// a handle. No place: the number of places. A sample's own point is a blend like those around it, with smooth
// weights: alone it would stick out of them.
template<typename Number>
std::size_t place_of_all(const SampleRow<Number>& row, Index first_handle, InfluenceWeights weights) {
    for (std::size_t k = 0; k < influences_per_row && row.distance[k] == 0; ++k)
        if (weights == InfluenceWeights::paper || row.sample[k] >= first_handle) return k;
    return influences_per_row;
}

// The weight of each place of a row, times the same for all: they are to be divided by their sum, which is 0
// only for an empty row. Empty places have 0. A handle at d = 0 is taken alone (with the weights of the paper
// a sample, too), and a full row of equal distances shares evenly. Smooth is (d_max - d)², distances being
// whole numbers, and exact where that is below 2^24. `first_handle`: of InfluenceRows.
template<typename Number>
std::array<float, influences_per_row> weights_of(const SampleRow<Number>& row, Index first_handle,
                                                 InfluenceWeights weights) {
    std::array<float, influences_per_row> weight{};
    const std::size_t count = row.count();
    if (count == 0) return weight;
    const Number farthest = row.distance[count - 1];
    if (const std::size_t all = place_of_all(row, first_handle, weights); all < influences_per_row) {
        weight[all] = 1;
    } else if (weights == InfluenceWeights::paper) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto distance = static_cast<float>(row.distance[k]);
            weight[k] = 1.0F / (distance * distance);
        }
    } else {
        for (std::size_t k = 0; k < count; ++k) {
            auto nearness = static_cast<float>(static_cast<Number>(farthest - row.distance[k]));
            if (count < influences_per_row) nearness += static_cast<float>(farthest);
            weight[k] = nearness * nearness;
            if (row.sample[k] >= first_handle) weight[k] *= growth_of_handle(row.distance[k], farthest);
        }
        if (std::ranges::all_of(weight, [](float each) { return each == 0; }))
            std::fill_n(weight.begin(), count, 1.0F); // all are as far
    }
    return weight;
}

// What moves a point.
struct Influence {
    std::array<Index, influences_per_row> motion;
    std::array<float, influences_per_row> weight; // they sum to 1; all 0 if nothing moves it
    std::size_t count = 0;                        // places in use; the others have motion 0 and weight 0
};

// By a row. `first_handle`: of InfluenceRows.
Influence influence_of(const WideRow& row, Index first_handle, InfluenceWeights weights);

// By the number that a point or vertex has for what moves it: below rows.size() the row of that number, whose
// samples are motions; from there on one motion alone, the one numbered `number` - rows.size().
Influence influence_of(const InfluenceRows& rows, InfluenceWeights weights, Index number);

} // namespace knead

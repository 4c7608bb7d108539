#include "graph/territory_areas.h"

#include "base/require.h"
#include "graph/star_weights.h"

#include <algorithm>

namespace knead {

namespace {

constexpr std::size_t asked_a_sample = 16;

// More hardly change what one vertex finds out by itself.
constexpr int updates = 2;

// What vertices stand for, one after the other in the same memory.
class AreaFinder {
public:
    AreaFinder(const Graph& points, std::span<const float> positions, const Numbering& point,
               std::span<const std::uint8_t> hanging)
        : points_(points), positions_(positions), point_(point), hanging_(hanging) {}

    double find(Index vertex) {
        if (hangs(vertex)) return 0;
        star_.clear();
        const Vec3d own = position_of(vertex);
        for (const Index other : points_.row(vertex))
            if (!hangs(other)) star_.push_back(spoke_along(position_of(other) - own, 1));
        if (star_.empty()) return 0;
        weight_.resize(star_.size());
        const double sum = start_weights(star_, weight_);
        for (int update = 0; update < updates; ++update) even_out(star_, sum, weight_);
        return area_of(star_, weight_);
    }

private:
    bool hangs(Index vertex) const { return !hanging_.empty() && hanging_[vertex] != 0; }
    Vec3d position_of(Index vertex) const { return point_at(positions_, point_[vertex]); }

    const Graph& points_;
    std::span<const float> positions_;
    const Numbering& point_;
    std::span<const std::uint8_t> hanging_;
    std::vector<Spoke> star_;
    std::vector<double> weight_;
};

} // namespace

AskedVertices ask_vertices(const Graph& points, std::span<const float> positions, const Numbering& point,
                           std::span<const std::uint8_t> hanging, std::size_t samples, Workers& workers) {
    const std::size_t vertices = points.size(), count = std::min(asked_a_sample * samples, vertices);
    AskedVertices asked;
    if (count == 0) return asked;
    asked.each = static_cast<double>(vertices) / static_cast<double>(count);
    asked.vertex.resize(count);
    asked.area.resize(count);
    workers.for_chunks(count, 1024, [&](std::size_t begin, std::size_t end) {
        AreaFinder finder(points, positions, point, hanging);
        for (std::size_t k = begin; k < end; ++k) {
            asked.vertex[k] = static_cast<Index>(k * vertices / count);
            asked.area[k] = static_cast<float>(finder.find(asked.vertex[k]));
        }
    });
    return asked;
}

std::vector<double> territory_areas(const AskedVertices& asked, const ChangingTerritories& territories,
                                    std::size_t samples, Workers& workers) {
    const std::vector<Index> sample = nearest_samples(territories, asked.vertex, workers);
    std::vector<double> area(samples, 0.0);
    for (std::size_t k = 0; k < sample.size(); ++k) {
        if (sample[k] == no_index) continue;
        require(sample[k] < samples, "territories are those of the samples");
        area[sample[k]] += asked.each * static_cast<double>(asked.area[k]);
    }
    return area;
}

} // namespace knead

#include "graph/flood.h"

#include "base/gathered.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <numeric>

namespace knead {

namespace {

constexpr std::uint32_t ring = 64; // levels that can wait at a time: one more than the longest link
constexpr double levels_a_median_link = 4;
constexpr Index vertices_a_tile = 4096; // their rows and links stay in a core's own cache

// A sample on its way, `distance` levels from where it started when it reaches the vertex.
struct Arrival {
    Index vertex;
    Index sample;
    std::uint32_t distance;
};

// A row of K places: NearestSamples, or as narrow as is needed.
template<std::size_t K>
struct Row {
    std::array<Index, K> sample;
    std::array<std::uint32_t, K> distance;
};

constexpr std::uint32_t never = ~std::uint32_t{0};

template<typename Places>
Places empty_row() {
    Places row;
    row.sample.fill(no_index);
    row.distance.fill(never);
    return row;
}

// Where the sample stands in the row; its size where it does not.
template<typename Places>
std::size_t place_of(const Places& row, Index sample) {
    std::size_t place = row.sample.size();
    for (std::size_t k = 0; k < row.sample.size(); ++k)
        if (row.sample[k] == sample) place = k;
    return place;
}

template<typename Places>
bool is_before(const Places& row, std::size_t place, Index sample, std::uint32_t distance) {
    return row.distance[place] < distance || (row.distance[place] == distance && row.sample[place] < sample);
}

// Whether putting the sample there would change the row.
template<typename Places>
bool has_room(const Places& row, Index sample, std::uint32_t distance) {
    if (is_before(row, row.sample.size() - 1, sample, distance)) return false;
    const std::size_t place = place_of(row, sample);
    return place == row.sample.size() || distance < row.distance[place];
}

// Puts it there, in place of itself farther away, or of the last one.
template<typename Places>
void insert(Places& row, Index sample, std::uint32_t distance) {
    std::size_t at = std::min(place_of(row, sample), row.sample.size() - 1);
    for (; at > 0 && !is_before(row, at - 1, sample, distance); --at) {
        row.sample[at] = row.sample[at - 1];
        row.distance[at] = row.distance[at - 1];
    }
    row.sample[at] = sample;
    row.distance[at] = distance;
}

// One flood. Vertices are numbered so that neighbours have near numbers (PointOrder), and a tile is so many
// of them in a row. In a round every tile that something arrives at is flooded by one worker, nearest first,
// as if there were no other; what leaves it arrives elsewhere in the next round.
//
// So a sample may reach a vertex by a way round before it does by the shortest one, which then takes its
// place. Distances in a row never grow, and one that is too long cannot push out for good what belongs there:
// the K that stand before it are no farther than they seem. What remains in the end is the first K by
// (distance, sample) of all ways, whatever the tiles and the order in which workers took them.
template<typename Places>
class Flood {
public:
    struct OldRow {
        Index vertex;
        Places row;
    };

    Flood(std::vector<Places>& rows, const Graph& graph, std::span<const std::uint8_t> lengths,
          Workers& workers)
        : rows_(rows), graph_(graph), lengths_(lengths), workers_(workers) {
        require(lengths.size() == graph.neighbor.size(), "a length a link");
    }

    // Samples are numbered from `first`. Rows are kept as they were before, if `keep_old` says so.
    void run(std::span<const Index> starts, Index first, bool keep_old, Progress& progress) {
        if (keep_old) kept_.assign(graph_.size(), 0);
        {
            Gathered<Arrival>::Block block(leaving_);
            for (std::size_t i = 0; i < starts.size(); ++i)
                block.push({starts[i], first + static_cast<Index>(i), 0});
        }
        for (int round = 0; !leaving_.items().empty(); ++round) {
            progress.step("measuring along the surface", 1 - 1 / (1 + 0.1 * round));
            sort_by_tile();
            leaving_.clear();
            std::atomic<std::size_t> next = 0;
            workers_.for_each(std::min<std::size_t>(workers_.threads(), tiles_.size()), 1, [&](std::size_t) {
                Gathered<Arrival>::Block leaving(leaving_);
                typename Gathered<OldRow>::Block old(old_rows_);
                Waiting waiting;
                for (std::size_t t = next++; t < tiles_.size(); t = next++)
                    flood_tile(tiles_[t], waiting, leaving, keep_old ? &old : nullptr);
            });
        }
    }

    std::span<const OldRow> old_rows() const { return old_rows_.items(); }

private:
    // What arrives at a tile.
    struct Tile {
        Index first_vertex;
        std::span<Arrival> arriving;
    };
    // What is on its way inside a tile, by the level at which it goes on.
    using Waiting = std::array<std::vector<Arrival>, ring>;

    // Makes `tiles_` of what left tiles in the round before.
    void sort_by_tile() {
        const std::span<const Arrival> left = leaving_.items();
        std::vector<std::size_t> begin(graph_.size() / vertices_a_tile + 2, 0);
        for (const Arrival& arrival : left) ++begin[arrival.vertex / vertices_a_tile + 1];
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        tiles_.clear();
        arriving_.resize(left.size());
        for (std::size_t t = 0; t + 1 < begin.size(); ++t)
            if (begin[t] < begin[t + 1])
                tiles_.push_back({static_cast<Index>(t * vertices_a_tile),
                                  std::span(arriving_).subspan(begin[t], begin[t + 1] - begin[t])});
        for (const Arrival& arrival : left) arriving_[begin[arrival.vertex / vertices_a_tile]++] = arrival;
    }

    void flood_tile(const Tile& tile, Waiting& waiting, Gathered<Arrival>::Block& leaving,
                    typename Gathered<OldRow>::Block* old) {
        const Index end = std::min(tile.first_vertex + vertices_a_tile, static_cast<Index>(graph_.size()));
        std::ranges::sort(tile.arriving, {}, &Arrival::distance);
        std::size_t arrived = 0, waits = 0;
        std::uint32_t level = 0;
        const auto take_in = [&](const Arrival& arrival) {
            if (!has_room(rows_[arrival.vertex], arrival.sample, arrival.distance)) return;
            if (old) keep(arrival.vertex, *old);
            insert(rows_[arrival.vertex], arrival.sample, arrival.distance);
            waiting[arrival.distance % ring].push_back(arrival);
            ++waits;
        };
        while (waits > 0 || arrived < tile.arriving.size()) {
            if (waits == 0) level = tile.arriving[arrived].distance;
            for (; arrived < tile.arriving.size() && tile.arriving[arrived].distance == level; ++arrived)
                take_in(tile.arriving[arrived]);
            std::vector<Arrival>& going = waiting[level % ring];
            waits -= going.size();
            for (const auto& [v, sample, distance] : going) {
                const std::size_t place = place_of(rows_[v], sample);
                if (place == rows_[v].sample.size() || rows_[v].distance[place] != distance) continue;
                for (Index link = graph_.first[v]; link < graph_.first[v + 1]; ++link) {
                    const Arrival next{graph_.neighbor[link], sample, distance + lengths_[link]};
                    if (next.vertex >= tile.first_vertex && next.vertex < end)
                        take_in(next);
                    else
                        leaving.push(next);
                }
            }
            going.clear();
            ++level;
        }
    }

    void keep(Index v, typename Gathered<OldRow>::Block& old) {
        if (kept_[v]) return;
        kept_[v] = 1;
        old.push({v, rows_[v]});
    }

    std::vector<Places>& rows_;
    const Graph& graph_;
    std::span<const std::uint8_t> lengths_;
    Workers& workers_;
    std::vector<std::uint8_t> kept_; // of each vertex, whether its old row was kept; empty if none are
    Gathered<Arrival> leaving_;      // in this round, for the next one
    std::vector<Arrival> arriving_;  // by tile
    std::vector<Tile> tiles_;
    Gathered<OldRow> old_rows_;
};

double length_of(const Graph& graph, std::span<const float> positions, std::size_t v, std::size_t link) {
    return (point_at(positions, v) - point_at(positions, graph.neighbor[link])).norm();
}

// The median length of a link, over at most some ten thousand of them, evenly chosen.
double median_length(const Graph& graph, std::span<const float> positions) {
    std::vector<double> lengths;
    const std::size_t stride = graph.size() / 4096 + 1;
    for (std::size_t v = 0; v < graph.size(); v += stride)
        for (std::size_t link = graph.first[v]; link < graph.first[v + 1]; ++link)
            lengths.push_back(length_of(graph, positions, v, link));
    if (lengths.empty()) return 1;
    const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
    std::ranges::nth_element(lengths, middle);
    return *middle;
}

} // namespace

std::vector<std::uint8_t> link_lengths(const Graph& graph, std::span<const float> positions,
                                       Workers& workers) {
    const double level = median_length(graph, positions) / levels_a_median_link;
    std::vector<std::uint8_t> lengths(graph.neighbor.size());
    workers.for_each(graph.size(), 4096, [&](std::size_t v) {
        for (std::size_t link = graph.first[v]; link < graph.first[v + 1]; ++link)
            lengths[link] = static_cast<std::uint8_t>(
                std::clamp(std::round(length_of(graph, positions, v, link) / level), 1.0, ring - 1.0));
    });
    return lengths;
}

std::vector<Index> shuffled(std::vector<Index> vertices) {
    // The finaliser of SplitMix64 (G. L. Steele, D. Lea, C. H. Flood, "Fast splittable pseudorandom number
    // generators").
    const auto scrambled = [](Index v) {
        std::uint64_t z = (v + 1) * 0x9e3779b97f4a7c15ULL;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
        return z ^ (z >> 31);
    };
    std::ranges::sort(vertices, {}, scrambled);
    return vertices;
}

std::vector<NearestSamples> flood(const Graph& graph, std::span<const std::uint8_t> lengths,
                                  std::span<const Index> samples, Workers& workers, Progress& progress) {
    std::vector<NearestSamples> nearest(graph.size(), empty_row<NearestSamples>());
    Flood(nearest, graph, lengths, workers).run(samples, 0, false, progress);
    return nearest;
}

std::vector<Index> territories(const Graph& graph, std::span<const std::uint8_t> lengths,
                               std::span<const Index> samples, Workers& workers, Progress& progress) {
    std::vector<Row<1>> rows(graph.size(), empty_row<Row<1>>());
    Flood(rows, graph, lengths, workers).run(samples, 0, false, progress);
    std::vector<Index> nearest(graph.size());
    for (std::size_t v = 0; v < graph.size(); ++v) nearest[v] = rows[v].sample[0];
    return nearest;
}

FloodPatch add_samples(std::vector<NearestSamples>& nearest, const Graph& graph,
                       std::span<const std::uint8_t> lengths, std::span<const Index> added, Index first_new,
                       Workers& workers, Progress& progress) {
    Flood flood(nearest, graph, lengths, workers);
    flood.run(added, first_new, true, progress);
    FloodPatch patch;
    patch.rows.reserve(flood.old_rows().size());
    for (const auto& old : flood.old_rows()) patch.rows.push_back({old.vertex, old.row});
    return patch;
}

void revert(std::vector<NearestSamples>& nearest, const FloodPatch& patch) {
    for (const FloodPatch::Row& row : patch.rows) nearest[row.vertex] = row.nearest;
}

} // namespace knead

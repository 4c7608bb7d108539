#include "graph/flood.h"

#include "base/gathered.h"
#include "base/require.h"
#include "graph/scrambled.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace knead {

namespace {

constexpr std::uint32_t ring = 64; // levels that can wait at a time: one more than the longest link
constexpr double levels_a_median_link = 4;
constexpr Index vertices_a_tile = 4096; // their rows and links stay in a core's own cache

// A row of the nearest sample alone.
template<typename Value>
struct Territory {
    static constexpr Value none = std::numeric_limits<Value>::max();
    std::array<Value, 1> sample, distance;
};

// How wide the numbers of a row are.
template<typename Places>
using NumberOf = typename decltype(Places::sample)::value_type;

// A sample on its way, `distance` levels from where it started when it reaches the vertex.
template<typename Number>
struct Arrival {
    Index vertex;
    Number sample, distance;
};

template<typename Places>
Places empty_row() {
    Places row;
    row.sample.fill(Places::none);
    row.distance.fill(Places::none);
    return row;
}

// Where the sample stands in the row; its size where it does not.
template<typename Places>
std::size_t place_of(const Places& row, NumberOf<Places> sample) {
    std::size_t place = row.sample.size();
    for (std::size_t k = 0; k < row.sample.size(); ++k)
        if (row.sample[k] == sample) place = k;
    return place;
}

template<typename Places>
bool is_before(const Places& row, std::size_t place, NumberOf<Places> sample, NumberOf<Places> distance) {
    return row.distance[place] < distance || (row.distance[place] == distance && row.sample[place] < sample);
}

// Whether putting the sample there would change the row.
template<typename Places>
bool has_room(const Places& row, NumberOf<Places> sample, NumberOf<Places> distance) {
    if (is_before(row, row.sample.size() - 1, sample, distance)) return false;
    const std::size_t place = place_of(row, sample);
    return place == row.sample.size() || distance < row.distance[place];
}

// Puts it there, in place of itself farther away, or of the last one.
template<typename Places>
void insert(Places& row, NumberOf<Places> sample, NumberOf<Places> distance) {
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
    using Number = NumberOf<Places>;
    using Old = OldRow<Places>;

    Flood(std::vector<Places>& rows, const Graph& graph, std::span<const std::uint8_t> lengths,
          Workers& workers)
        : rows_(rows), graph_(graph), lengths_(lengths), workers_(workers) {
        require(lengths.size() == graph.neighbor.size(), "a length a link");
    }

    // Samples are numbered from `first`. Rows are kept as they were before, if `keep_old` says so. Returns
    // whether all distances fit into the rows; if not, the flood was broken off.
    bool run(std::span<const Index> starts, Index first, bool keep_old, Progress& progress) {
        require(first + starts.size() <= Places::none, "numbers of samples fit into the rows");
        if (keep_old) kept_.assign(graph_.size(), 0);
        {
            typename Gathered<Arrival<Number>>::Block block(leaving_);
            for (std::size_t i = 0; i < starts.size(); ++i)
                block.push({starts[i], static_cast<Number>(first + i), 0});
        }
        for (int round = 0; leaving_.size() > 0 && !too_far_; ++round) {
            progress.step("measuring along the surface", 1 - 1 / (1 + 0.1 * round));
            sort_by_tile();
            std::atomic<std::size_t> next = 0;
            workers_.for_each(std::min<std::size_t>(workers_.threads(), tiles_.size()), 1, [&](std::size_t) {
                typename Gathered<Arrival<Number>>::Block leaving(leaving_);
                typename Gathered<Old>::Block old(old_rows_);
                Waiting waiting;
                for (std::size_t t = next++; t < tiles_.size() && !too_far_; t = next++)
                    flood_tile(tiles_[t], waiting, leaving, keep_old ? &old : nullptr);
            });
        }
        return !too_far_;
    }

    // Hands over the rows as they were before.
    OldRows<Places> take_old_rows() { return old_rows_.take_blocks(); }

private:
    // What arrives at a tile.
    struct Tile {
        Index first_vertex;
        std::span<Arrival<Number>> arriving;
    };
    // What is on its way inside a tile, by the level at which it goes on.
    using Waiting = std::array<std::vector<Arrival<Number>>, ring>;

    // Makes `tiles_` of what left tiles in the round before.
    void sort_by_tile() {
        std::vector<std::size_t> begin(graph_.size() / vertices_a_tile + 2, 0);
        leaving_.each([&](const Arrival<Number>& left) { ++begin[left.vertex / vertices_a_tile + 1]; });
        std::partial_sum(begin.begin(), begin.end(), begin.begin());
        tiles_.clear();
        arriving_.clear(); // or growing it would keep what it held
        arriving_.resize(leaving_.size());
        for (std::size_t t = 0; t + 1 < begin.size(); ++t)
            if (begin[t] < begin[t + 1])
                tiles_.push_back({static_cast<Index>(t * vertices_a_tile),
                                  std::span(arriving_).subspan(begin[t], begin[t + 1] - begin[t])});
        leaving_.take(
            [&](const Arrival<Number>& left) { arriving_[begin[left.vertex / vertices_a_tile]++] = left; });
    }

    void flood_tile(const Tile& tile, Waiting& waiting, typename Gathered<Arrival<Number>>::Block& leaving,
                    typename Gathered<Old>::Block* old) {
        const Index end = std::min(tile.first_vertex + vertices_a_tile, static_cast<Index>(graph_.size()));
        std::ranges::sort(tile.arriving, {}, &Arrival<Number>::distance);
        std::size_t arrived = 0, waits = 0;
        std::uint32_t level = 0;
        const auto take_in = [&](const Arrival<Number>& arrival) {
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
            std::vector<Arrival<Number>>& going = waiting[level % ring];
            waits -= going.size();
            for (const auto& [v, sample, distance] : going) {
                const std::size_t place = place_of(rows_[v], sample);
                if (place == rows_[v].sample.size() || rows_[v].distance[place] != distance) continue;
                if (distance >= Places::none - ring) too_far_ = true;
                if (too_far_) return;
                for (Index link = graph_.first[v]; link < graph_.first[v + 1]; ++link) {
                    const Arrival<Number> next{graph_.neighbor[link], sample,
                                               static_cast<Number>(distance + lengths_[link])};
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

    void keep(Index v, typename Gathered<Old>::Block& old) {
        if (kept_[v]) return;
        kept_[v] = 1;
        old.push({v, rows_[v].sample, rows_[v].distance});
    }

    std::vector<Places>& rows_;
    const Graph& graph_;
    std::span<const std::uint8_t> lengths_;
    Workers& workers_;
    std::atomic<bool> too_far_ = false;     // something is farther away than its row can tell
    std::vector<std::uint8_t> kept_;        // of each vertex, whether its old row was kept; empty if none are
    Gathered<Arrival<Number>> leaving_;     // in this round, for the next one
    std::vector<Arrival<Number>> arriving_; // by tile
    std::vector<Tile> tiles_;
    Gathered<Old> old_rows_;
};

// Floods narrow rows where they will do, else wide ones, and returns what use(rows) makes of them.
template<typename Narrow, typename Wide, typename Use>
auto flooded(const Graph& graph, std::span<const std::uint8_t> lengths, std::span<const Index> samples,
             Workers& workers, Progress& progress, Use&& use) {
    if (samples.size() < Narrow::none) {
        std::vector<Narrow> rows(graph.size(), empty_row<Narrow>());
        if (Flood(rows, graph, lengths, workers).run(samples, 0, false, progress)) return use(rows);
    }
    std::vector<Wide> rows(graph.size(), empty_row<Wide>());
    require(Flood(rows, graph, lengths, workers).run(samples, 0, false, progress),
            "a way along the surface is shorter than 2^32 levels");
    return use(rows);
}

// Puts old rows back.
template<typename Places>
void put_back(const OldRows<Places>& blocks, std::vector<Places>& rows) {
    for (const auto& block : blocks)
        for (const OldRow<Places>& old : block) rows[old.vertex] = {old.sample, old.distance};
}

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
    std::ranges::sort(vertices, {}, scrambled);
    return vertices;
}

InfluenceRows flood(const Graph& graph, std::span<const std::uint8_t> lengths, std::span<const Index> samples,
                    Workers& workers, Progress& progress) {
    return flooded<NarrowRow, WideRow>(graph, lengths, samples, workers, progress,
                                       [](auto& rows) { return InfluenceRows{std::move(rows)}; });
}

std::vector<Index> territories(const Graph& graph, std::span<const std::uint8_t> lengths,
                               std::span<const Index> samples, Workers& workers, Progress& progress) {
    return flooded<Territory<std::uint16_t>, Territory<Index>>(
        graph, lengths, samples, workers, progress, []<typename Row>(const std::vector<Row>& rows) {
            std::vector<Index> nearest(rows.size());
            std::ranges::transform(rows, nearest.begin(), [](const Row& row) {
                return row.sample[0] == Row::none ? no_index : Index{row.sample[0]};
            });
            return nearest;
        });
}

FloodPatch add_samples(InfluenceRows& nearest, const Graph& graph, std::span<const std::uint8_t> lengths,
                       std::span<const Index> added, Index first_new, Workers& workers, Progress& progress) {
    auto* narrow = std::get_if<std::vector<NarrowRow>>(&nearest.rows);
    if (narrow && first_new + added.size() <= NarrowRow::none) {
        Flood flood(*narrow, graph, lengths, workers);
        const bool fits = flood.run(added, first_new, true, progress);
        auto old_rows = flood.take_old_rows();
        if (fits) return {std::move(old_rows)};
        put_back(old_rows, *narrow);
    }
    widen(nearest);
    Flood flood(std::get<std::vector<WideRow>>(nearest.rows), graph, lengths, workers);
    require(flood.run(added, first_new, true, progress),
            "a way along the surface is shorter than 2^32 levels");
    return {flood.take_old_rows()};
}

void revert(InfluenceRows& nearest, const FloodPatch& patch) {
    require(nearest.rows.index() == patch.blocks.index(), "a patch belongs to the rows that it was made of");
    std::visit(
        [&]<typename Row>(std::vector<Row>& rows) { put_back(std::get<OldRows<Row>>(patch.blocks), rows); },
        nearest.rows);
}

} // namespace knead

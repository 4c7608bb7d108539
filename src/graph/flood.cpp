#include "graph/flood.h"

#include "base/locked.h"
#include "base/prefetch.h"
#include "base/require.h"
#include "graph/link_lengths.h"
#include "graph/scrambled.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <functional>
#include <limits>
#include <tuple>
#include <utility>

namespace knead {

namespace {

using Level = std::uint64_t;                  // no sum of two distances overflows
constexpr std::uint32_t levels_a_round = 512; // fewer are more rounds, more are more ways round
// What goes on together: fewer levels are steps too short to look ahead, more are more ways round.
constexpr std::uint32_t levels_a_step = 4;
constexpr std::uint32_t ring = 256; // steps that can wait at a time: those of a round and a link
static_assert(levels_a_round % levels_a_step == 0 && (longest_link + 1) % levels_a_step == 0);
static_assert(ring > (levels_a_round + longest_link) / levels_a_step + 1);
// Of vertices a tile. Larger ones send less to each other, and smaller ones leave something for every core.
constexpr std::size_t largest_tile = 1 << 14, smallest_tile = 1 << 10, fewest_tiles = 8;

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

// The loops over a row decide nothing on the way, and count in numbers as wide as its own: so compilers make
// a few instructions of each, for all its places together, if the functions are not put into larger loops.

template<typename Places>
constexpr std::size_t places_of = std::tuple_size_v<decltype(Places::sample)>;

template<typename Places>
[[gnu::noinline]] bool holds(const Places& row, NumberOf<Places> sample, NumberOf<Places> distance) {
    using Number = NumberOf<Places>;
    Number found = 0;
    for (std::size_t k = 0; k < places_of<Places>; ++k)
        found |= static_cast<Number>(Number{row.sample[k] == sample} & Number{row.distance[k] == distance});
    return found != 0;
}

// Whether putting the sample there would change the row.
template<typename Places>
[[gnu::noinline]] bool has_room(const Places& row, NumberOf<Places> sample, NumberOf<Places> distance) {
    using Number = NumberOf<Places>;
    constexpr std::size_t last = places_of<Places> - 1;
    const int as_far = row.distance[last] == distance;
    const int before_last = int{row.distance[last] > distance} | (as_far & int{row.sample[last] > sample});
    Number found = 0;
    for (std::size_t k = 0; k < places_of<Places>; ++k)
        found |= static_cast<Number>(Number{row.sample[k] == sample} & Number{row.distance[k] <= distance});
    return (before_last & int{found == 0}) != 0;
}

// Puts it there, in place of itself farther away, or of the last one.
template<typename Places>
[[gnu::noinline]] void insert(Places& row, NumberOf<Places> sample, NumberOf<Places> distance) {
    using Number = NumberOf<Places>;
    const Places old = row;
    Number nearer = 0;
    for (std::size_t k = 0; k < places_of<Places>; ++k) {
        const auto as_far = Number{old.distance[k] == distance};
        nearer = static_cast<Number>(
            nearer + (Number{old.distance[k] < distance} | (as_far & Number{old.sample[k] < sample})));
    }
    std::size_t place = nearer;
    row.sample[place] = sample;
    row.distance[place] = distance;
    for (; place + 1 < places_of<Places> && old.sample[place] != sample; ++place) {
        row.sample[place + 1] = old.sample[place];
        row.distance[place + 1] = old.distance[place];
    }
}

// One flood. Vertices are numbered so that neighbours have near numbers (PointOrder), and a tile is so many
// of them in a row. In a round every tile where something waits is flooded by one worker, nearest first (but
// what a step of some levels holds in any order), as if there were no other; what leaves it arrives elsewhere
// in the next round.
//
// So a sample may reach a vertex by a way round before it does by the shortest one, which then takes its
// place. Distances in a row never grow, and one that is too long cannot push out for good what belongs there:
// the K that stand before it are no farther than they seem. What remains in the end is the first K by
// (distance, sample) of all ways, whatever the tiles and the order in which workers took them. But all that
// comes by a way round is sent on in vain: a round goes no more than `levels_a_round` beyond the lowest level
// at which anything waits.
template<typename Places>
class Flood {
public:
    using Number = NumberOf<Places>;

    Flood(std::vector<Places>& rows, const Graph& graph, std::span<const std::uint8_t> lengths,
          Workers& workers)
        : rows_(rows), graph_(graph), lengths_(lengths), workers_(workers),
          vertices_a_tile_(static_cast<Index>(
              std::clamp(std::bit_floor(graph.size() / fewest_tiles), smallest_tile, largest_tile))),
          tiles_(graph.size() / vertices_a_tile_ + 1) {
        require(lengths.size() == graph.neighbor.size(), "a length a link");
        for (std::size_t t = 0; t < tiles_.size(); ++t)
            tiles_[t].first_vertex = static_cast<Index>(t * vertices_a_tile_);
    }

    // Rows are kept as they were before, if `keep_old` says so. Returns whether all distances fit into the
    // rows; if not, the flood was broken off.
    bool run(std::span<const FloodStart> starts, bool keep_old, Progress& progress) {
        if (keep_old) {
            is_kept_.assign(graph_.size() / kept_a_word + 1, 0);
            old_rows_.resize(blocks_of_rows(graph_.size()));
        }
        for (const FloodStart& start : starts)
            require(start.number < Places::none && start.distance < Places::none,
                    "numbers of samples and their distances fit into the rows");
        starts_.assign(starts.begin(), starts.end());
        std::ranges::sort(starts_, std::greater{}, &FloodStart::distance);
        std::vector<OnTheWay> of_worker(workers_.threads());
        for (OnTheWay& on_the_way : of_worker) on_the_way.leaving.resize(tiles_.size());
        for (int round = 0; start_round() && !too_far_; ++round) {
            progress.step("measuring along the surface", 1 - 1 / (1 + 0.05 * round));
            std::atomic<std::size_t> next = 0;
            workers_.for_each(of_worker.size(), 1, [&](std::size_t worker) {
                OnTheWay& on_the_way = of_worker[worker];
                for (std::size_t t = next++; t < busy_.size() && !too_far_; t = next++) {
                    flood_tile(*busy_[t], on_the_way);
                    hand_over(on_the_way);
                }
            });
        }
        return !too_far_;
    }

    // Hands over the rows as they were before.
    OldRows<Places> take_old_rows() { return std::move(old_rows_); }

private:
    using Arrivals = std::vector<Arrival<Number>>;
    static constexpr Level never = std::numeric_limits<Level>::max();

    // What has come to a tile, and the lowest level of that.
    struct Arrived {
        Arrivals all;
        Level lowest = never;

        // Takes them from there, and trades memory when it is empty.
        void take(Arrivals& more, Level lowest_of_more) {
            lowest = std::min(lowest, lowest_of_more);
            if (all.empty()) all.swap(more);
            all.insert(all.end(), more.begin(), more.end());
            more.clear();
        }
    };
    struct Tile {
        Index first_vertex = 0;
        Arrived arriving;        // came before this round
        Arrivals unfinished;     // stand in their rows, but were not sent on yet
        Level lowest = never;    // of both
        Locked<Arrived> arrived; // in this round, for a later one
    };

    // What a worker has in hand.
    struct OnTheWay {
        std::array<Arrivals, ring> waiting; // inside a tile, by the step in which it goes on
        std::vector<Arrivals> leaving;      // by the tile that it goes to
        std::vector<Index> destinations;    // of what is leaving

        Arrivals& waiting_at(Level level) { return waiting[level / levels_a_step % ring]; }
    };

    static Level next_step(Level level) { return level - level % levels_a_step + levels_a_step; }

    // Finds the tiles that this round floods, and up to which level. Returns whether there are any.
    bool start_round() {
        Level lowest = never;
        for (Tile& tile : tiles_) {
            tile.arrived.with([&](Arrived& arrived) {
                tile.arriving.take(arrived.all, std::exchange(arrived.lowest, never));
            });
            tile.lowest = std::min(tile.lowest, tile.arriving.lowest);
            lowest = std::min(lowest, tile.lowest);
        }
        if (!starts_.empty()) lowest = std::min<Level>(lowest, starts_.back().distance);
        busy_.clear();
        if (lowest == never) return false;
        end_ = lowest - lowest % levels_a_step + levels_a_round;
        let_start();
        for (Tile& tile : tiles_)
            if (tile.lowest < end_) busy_.push_back(&tile);
        return true;
    }

    // Brings to their tiles the starts of this round. Others would be more levels away than can wait.
    void let_start() {
        for (; !starts_.empty() && starts_.back().distance < end_; starts_.pop_back()) {
            const FloodStart& start = starts_.back();
            Tile& tile = tiles_[start.vertex / vertices_a_tile_];
            tile.arriving.all.push_back(
                {start.vertex, static_cast<Number>(start.number), static_cast<Number>(start.distance)});
            tile.arriving.lowest = std::min<Level>(tile.arriving.lowest, start.distance);
            tile.lowest = std::min(tile.lowest, tile.arriving.lowest);
        }
    }

    // Floods a tile up to the last level of this round.
    void flood_tile(Tile& tile, OnTheWay& on_the_way) {
        const Arrivals& arriving = tile.arriving.all;
        for (std::size_t i = 0; i < arriving.size(); ++i) {
            if (i + soon < arriving.size()) prefetch(&rows_[arriving[i + soon].vertex]);
            const auto& [vertex, sample, distance] = arriving[i];
            if (has_room(rows_[vertex], sample, distance)) take_in(arriving[i], on_the_way);
        }
        tile.arriving.all.clear();
        tile.arriving.lowest = never;
        for (const Arrival<Number>& arrival : tile.unfinished)
            on_the_way.waiting_at(arrival.distance).push_back(arrival);
        tile.unfinished.clear();
        for (Level level = tile.lowest; level < end_ && !too_far_; level = next_step(level)) {
            Arrivals& going = on_the_way.waiting_at(level);
            for (std::size_t i = 0; i < going.size(); ++i) { // it grows by links shorter than a step
                look_ahead(going, i);
                const Arrival<Number> arrival = going[i];
                if (holds(rows_[arrival.vertex], arrival.sample, arrival.distance))
                    pass_on(arrival, tile, on_the_way);
            }
            going.clear();
        }
        put_aside(tile, on_the_way);
    }

    // Arrivals of one step lie all over the tile. A core that went from one to the next would spend most of
    // its time waiting for where that leads to: so it asks for it some arrivals before, step by step.
    static constexpr std::size_t soon = 4;
    [[gnu::always_inline]] void look_ahead(const Arrivals& going, std::size_t i) const {
        if (i + 3 * soon < going.size()) {
            const Index v = going[i + 3 * soon].vertex;
            prefetch(&rows_[v]);
            prefetch(&graph_.first[v]);
        }
        if (i + 2 * soon < going.size()) {
            const Index link = graph_.first[going[i + 2 * soon].vertex];
            prefetch(graph_.neighbor.data() + link);
            prefetch(lengths_.data() + link);
        }
        if (i + soon < going.size())
            for (const Index neighbor : graph_.row(going[i + soon].vertex)) prefetch(&rows_[neighbor]);
    }

    // Puts it into its row, which has room for it.
    void take_in(const Arrival<Number>& arrival, OnTheWay& on_the_way) {
        if (!is_kept_.empty()) keep(arrival.vertex);
        insert(rows_[arrival.vertex], arrival.sample, arrival.distance);
        on_the_way.waiting_at(arrival.distance).push_back(arrival);
    }

    void pass_on(const Arrival<Number>& from, const Tile& tile, OnTheWay& on_the_way) {
        if (from.distance >= Places::none - longest_link) {
            too_far_ = true;
            return;
        }
        const Index end = graph_.first[from.vertex + 1];
        for (Index left = end - graph_.first[from.vertex]; left > 0;) {
            const Index count = std::min(left, links_at_once);
            pass_on_by(end - left, count, from, tile, on_the_way);
            left -= count;
        }
    }

    // By `count` links from `first` on. Which of them lead to where there is room is found out for all before
    // anything changes, and without a decision on the way, so that a core asks for all these rows at once.
    // (They lead to different vertices, so that none of the changes takes another's room.)
    using Links = std::uint32_t; // a set of them
    static constexpr Index links_at_once = std::numeric_limits<Links>::digits;
    void pass_on_by(Index first, Index count, const Arrival<Number>& from, const Tile& tile,
                    OnTheWay& on_the_way) {
        const auto arrival_by = [&](Index link) {
            return Arrival<Number>{graph_.neighbor[link], from.sample,
                                   static_cast<Number>(from.distance + lengths_[link])};
        };
        Links staying = 0, leaving = 0;
        for (Index k = 0; k < count; ++k) {
            const Arrival<Number> next = arrival_by(first + k);
            const bool inside = next.vertex - tile.first_vertex < vertices_a_tile_;
            // The rows of other tiles may be changing: another is looked at for them.
            const Places& row = rows_[inside ? next.vertex : from.vertex];
            staying |= Links{has_room(row, next.sample, next.distance)} << k;
            leaving |= Links{!inside} << k;
        }
        staying &= ~leaving;
        for (; staying != 0; staying &= staying - 1)
            take_in(arrival_by(first + static_cast<Index>(std::countr_zero(staying))), on_the_way);
        for (; leaving != 0; leaving &= leaving - 1)
            send(arrival_by(first + static_cast<Index>(std::countr_zero(leaving))), on_the_way);
    }

    // Leaves with the tile what waits for later rounds.
    void put_aside(Tile& tile, OnTheWay& on_the_way) {
        tile.lowest = never;
        for (Level level = end_; level < end_ + longest_link; level = next_step(level)) {
            Arrivals& rest = on_the_way.waiting_at(level);
            if (!rest.empty()) tile.lowest = std::min(tile.lowest, level);
            tile.unfinished.insert(tile.unfinished.end(), rest.begin(), rest.end());
            rest.clear();
        }
    }

    void send(const Arrival<Number>& arrival, OnTheWay& on_the_way) {
        const Index tile = arrival.vertex / vertices_a_tile_;
        Arrivals& there = on_the_way.leaving[tile];
        if (there.empty()) on_the_way.destinations.push_back(tile);
        there.push_back(arrival);
    }

    void hand_over(OnTheWay& on_the_way) {
        for (const Index t : on_the_way.destinations) {
            Arrivals& leaving = on_the_way.leaving[t];
            Level lowest = never;
            for (const auto& arrival : leaving) lowest = std::min<Level>(lowest, arrival.distance);
            tiles_[t].arrived.with([&](Arrived& arrived) { arrived.take(leaving, lowest); });
        }
        on_the_way.destinations.clear();
    }

    // Whose rows they are is a matter of the tile alone, whose blocks and words are no other's.
    void keep(Index v) {
        std::uint64_t& word = is_kept_[v / kept_a_word];
        const std::uint64_t bit = std::uint64_t{1} << v % kept_a_word;
        if ((word & bit) != 0) return;
        word |= bit;
        old_rows_[v / rows_in_block].push({v, rows_[v].sample, rows_[v].distance});
    }
    static constexpr std::size_t kept_a_word = 64;
    static_assert(smallest_tile % kept_a_word == 0 && smallest_tile % rows_in_block == 0);

    std::vector<Places>& rows_;
    const Graph& graph_;
    std::span<const std::uint8_t> lengths_;
    Workers& workers_;
    std::atomic<bool> too_far_ = false;  // something is farther away than its row can tell
    std::vector<std::uint64_t> is_kept_; // a bit a vertex: whether its old row was kept; empty if none are
    OldRows<Places> old_rows_;           // empty if none are kept
    const Index vertices_a_tile_;        // a power of two, by the number of all vertices
    std::vector<Tile> tiles_;
    std::vector<FloodStart> starts_; // that are still to come, the nearest last
    std::vector<Tile*> busy_;        // in this round
    Level end_ = 0;                  // of the levels of this round
};

// Floods narrow rows where they will do, else wide ones, and returns what use(rows) makes of them.
template<typename Rows, typename Use>
auto flooded(const Graph& graph, std::span<const std::uint8_t> lengths, std::span<const Index> samples,
             Workers& workers, Progress& progress, Use&& use) {
    using Narrow = typename Rows::Narrow;
    using Wide = typename Rows::Wide;
    const std::vector<FloodStart> starts = starts_of(samples, 0);
    if (samples.size() < Narrow::none) {
        std::vector<Narrow> rows(graph.size(), empty_row<Narrow>());
        if (Flood<Narrow>(rows, graph, lengths, workers).run(starts, false, progress)) return use(rows);
    }
    std::vector<Wide> rows(graph.size(), empty_row<Wide>());
    require(Flood<Wide>(rows, graph, lengths, workers).run(starts, false, progress),
            "a way along the surface is shorter than 2^32 levels");
    return use(rows);
}

// Puts old rows back.
template<typename Row>
void put_back(const OldRows<Row>& blocks, std::vector<Row>& rows) {
    for (const auto& block : blocks)
        block.each([&](const OldRow<Row>& old) { rows[old.vertex] = {old.sample, old.distance}; });
}

} // namespace

InfluenceRows flood(const Graph& graph, std::span<const std::uint8_t> lengths, std::span<const Index> samples,
                    Workers& workers, Progress& progress) {
    return flooded<InfluenceRows>(graph, lengths, samples, workers, progress, [](auto& rows) {
        InfluenceRows nearest;
        nearest.rows = std::move(rows);
        return nearest;
    });
}

std::vector<Index> territories(const Graph& graph, std::span<const std::uint8_t> lengths,
                               std::span<const Index> samples, Workers& workers, Progress& progress) {
    return flooded<TerritoryRows>(graph, lengths, samples, workers, progress,
                                  []<typename Row>(const std::vector<Row>& rows) {
                                      std::vector<Index> nearest(rows.size());
                                      std::ranges::transform(rows, nearest.begin(), [](const Row& row) {
                                          return row.sample[0] == Row::none ? no_index : Index{row.sample[0]};
                                      });
                                      return nearest;
                                  });
}

std::vector<FloodStart> starts_of(std::span<const Index> samples, Index first) {
    std::vector<FloodStart> starts;
    starts.reserve(samples.size());
    for (const Index vertex : samples) starts.push_back({vertex, first++});
    return starts;
}

TerritoryRows territory_rows(const InfluenceRows& nearest, Workers& workers) {
    return std::visit(
        [&]<typename Number>(const std::vector<SampleRow<Number>>& rows) {
            std::vector<SampleRow<Number, 1>> first(rows.size());
            workers.for_each(rows.size(), largest_tile, [&](std::size_t v) {
                first[v] = {{rows[v].sample[0]}, {rows[v].distance[0]}};
            });
            return TerritoryRows{std::move(first)};
        },
        nearest.rows);
}

template<std::size_t places>
RowPatch<places> add_starts(NearestRows<places>& nearest, const Graph& graph,
                            std::span<const std::uint8_t> lengths, std::span<const FloodStart> starts,
                            Workers& workers, Progress& progress) {
    using Narrow = typename NearestRows<places>::Narrow;
    using Wide = typename NearestRows<places>::Wide;
    auto* narrow = std::get_if<std::vector<Narrow>>(&nearest.rows);
    const auto is_narrow = [](const FloodStart& start) {
        return start.number < Narrow::none && start.distance < Narrow::none;
    };
    if (narrow && std::ranges::all_of(starts, is_narrow)) {
        Flood<Narrow> flood(*narrow, graph, lengths, workers);
        const bool fits = flood.run(starts, true, progress);
        auto old_rows = flood.take_old_rows();
        if (fits) return {std::move(old_rows)};
        put_back(old_rows, *narrow);
    }
    widen(nearest);
    Flood<Wide> flood(std::get<std::vector<Wide>>(nearest.rows), graph, lengths, workers);
    require(flood.run(starts, true, progress), "a way along the surface is shorter than 2^32 levels");
    return {flood.take_old_rows()};
}

template FloodPatch add_starts(NearestRows<influences_per_row>&, const Graph&, std::span<const std::uint8_t>,
                               std::span<const FloodStart>, Workers&, Progress&);
template TerritoryPatch add_starts(TerritoryRows&, const Graph&, std::span<const std::uint8_t>,
                                   std::span<const FloodStart>, Workers&, Progress&);

} // namespace knead

#include "graph/flood.h"

#include "base/gathered.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace knead {

namespace {

constexpr std::uint32_t ring = 64; // levels that can wait at a time: one more than the longest link
constexpr double levels_a_median_link = 4;
constexpr std::size_t far_ahead = 16;
constexpr Index vertices_a_share =
    256; // neighbours in the order of the vertices are taken by the same worker

// A sample that reaches a vertex.
struct Arrival {
    Index vertex;
    Index sample;
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

// Whether a sample that arrives at a level would be among the K first.
template<typename Places>
bool has_room(const Places& row, Index sample, std::uint32_t level) {
    if (row.distance.back() < level || (row.distance.back() == level && row.sample.back() < sample))
        return false;
    bool there = false;
    for (const Index held : row.sample) there |= held == sample;
    return !there;
}

// Puts it there; the last one goes.
template<typename Places>
void insert(Places& row, Index sample, std::uint32_t level) {
    std::size_t at = row.sample.size() - 1;
    for (; at > 0; --at) {
        if (row.distance[at - 1] < level || (row.distance[at - 1] == level && row.sample[at - 1] < sample))
            break;
        row.sample[at] = row.sample[at - 1];
        row.distance[at] = row.distance[at - 1];
    }
    row.sample[at] = sample;
    row.distance[at] = level;
}

// One flood. A level has two steps, each over many arrivals at once: those that wait for the level are put
// into the rows of their vertices, and what was gained is sent on along the links, to arrive as many levels
// later as they are long.
//
// A row holds the first K by (distance, sample) of all that arrived, and levels come in ascending order, so
// it does not matter in which order the arrivals of a level are put in: the result depends on chance as
// little as on the workers.
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
            Gathered<Arrival>::Block block(waiting_[0]);
            for (std::size_t i = 0; i < starts.size(); ++i)
                block.push({starts[i], first + static_cast<Index>(i)});
        }
        std::uint32_t idle = 0;
        for (std::uint32_t level = 0; idle < ring; ++level) {
            Gathered<Arrival>& waiting = waiting_[level % ring];
            idle = waiting.items().empty() ? idle + 1 : 0;
            if (idle > 0) continue;
            if (level % 8 == 0) progress.step("measuring along the surface", 1 - 1 / (1 + 0.01 * level));
            put_in(waiting.items(), level, keep_old);
            waiting.clear();
            send_on(level);
        }
    }

    std::span<const OldRow> old_rows() const { return old_rows_.items(); }

private:
    // Every worker goes through all arrivals and takes those at vertices of its own share, so no row needs a
    // lock.
    void put_in(std::span<const Arrival> arrivals, std::uint32_t level, bool keep_old) {
        gained_.clear();
        const Index shares = arrivals.size() < 2048 ? 1 : workers_.threads();
        workers_.for_each(shares, 1, [&](std::size_t share) {
            typename Gathered<Arrival>::Block gained(gained_);
            typename Gathered<OldRow>::Block old(old_rows_);
            const auto is_own = [&](Index v) { return (v / vertices_a_share) % shares == share; };
            for (std::size_t i = 0; i < arrivals.size(); ++i) {
                if (i + far_ahead < arrivals.size() && is_own(arrivals[i + far_ahead].vertex))
                    prefetch(arrivals[i + far_ahead].vertex);
                const auto [v, sample] = arrivals[i];
                if (!is_own(v) || !has_room(rows_[v], sample, level)) continue;
                if (keep_old && !kept_[v]) {
                    kept_[v] = 1;
                    old.push({v, rows_[v]});
                }
                insert(rows_[v], sample, level);
                gained.push(arrivals[i]);
            }
        });
    }

    // Rows change only in put_in(), so here they are read without locks.
    void send_on(std::uint32_t level) {
        const std::span<const Arrival> gained = gained_.items();
        workers_.for_chunks(gained.size(), 1024, [&](std::size_t begin, std::size_t end) {
            Blocks blocks;
            std::array<Departure, 256> departures;
            std::size_t count = 0;
            const auto depart = [&] {
                for (std::size_t d = 0; d < count; ++d) put_in_line(departures[d], blocks);
                count = 0;
            };
            for (std::size_t i = begin; i < end; ++i) {
                if (i + far_ahead < end)
                    __builtin_prefetch(&graph_.neighbor[graph_.first[gained[i + far_ahead].vertex]]);
                const Index v = gained[i].vertex;
                for (Index link = graph_.first[v]; link < graph_.first[v + 1]; ++link) {
                    prefetch(graph_.neighbor[link]);
                    departures[count++] = {{graph_.neighbor[link], gained[i].sample}, level + lengths_[link]};
                    if (count == departures.size()) depart();
                }
            }
            depart();
        });
    }

    // On its way: arrives when.
    struct Departure {
        Arrival arrival;
        std::uint32_t when;
    };
    using Blocks = std::array<std::optional<typename Gathered<Arrival>::Block>, ring>;

    void put_in_line(const Departure& departure, Blocks& blocks) {
        const auto& [arrival, when] = departure;
        if (!has_room(rows_[arrival.vertex], arrival.sample, when)) return;
        auto& block = blocks[when % ring];
        if (!block) block.emplace(waiting_[when % ring]);
        block->push(arrival);
    }

    // Fronts run all over the cloud, so the rows they meet are rarely in the cache: they are asked for some
    // steps ahead.
    void prefetch(Index v) const { __builtin_prefetch(&rows_[v]); }

    std::vector<Places>& rows_;
    const Graph& graph_;
    std::span<const std::uint8_t> lengths_;
    Workers& workers_;
    std::vector<std::uint8_t> kept_; // of each vertex, whether its old row was kept; empty if none are
    std::array<Gathered<Arrival>, ring> waiting_; // for each of the next levels
    Gathered<Arrival> gained_;                    // at the level at hand
    Gathered<OldRow> old_rows_;
};

double length_of(const Graph& graph, std::span<const float> positions, std::size_t v, std::size_t link) {
    const auto at = [&](std::size_t u) {
        return Eigen::Map<const Vec3f>(positions.data() + 3 * u).cast<double>();
    };
    return (at(v) - at(graph.neighbor[link])).norm();
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

#include "graph/flood.h"

#include "base/gathered.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <optional>

namespace knead {

namespace {

constexpr std::uint32_t ring = 64; // levels that can wait at a time: one more than the longest link
constexpr double levels_a_median_link = 8;

// A sample that reaches, or has reached, a vertex.
struct Arrival {
    Index vertex;
    Index sample;
};

// One flood. A level has two steps, each over many arrivals at once: those that wait for the level are put
// into the rows of their vertices, and what was gained is sent on along the links, to arrive as many levels
// later as they are long.
//
// A row holds the first K by (distance, sample) of all that arrived, and levels come in ascending order, so
// it does not matter in which order the arrivals of a level are put in: the result depends on chance as
// little as on the workers.
class Flood {
public:
    Flood(FloodLists& lists, const Graph& graph, std::span<const std::uint8_t> lengths, Workers& workers)
        : lists_(lists), width_(lists.width), graph_(graph), lengths_(lengths), workers_(workers),
          state_(graph.size(), 0) {
        require(lengths.size() == graph.neighbor.size(), "a length a link");
    }

    // Samples are numbered from `first`. Rows are kept as they were, if `keep_old` says so.
    void run(std::span<const Index> starts, Index first, bool keep_old, Progress& progress) {
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

    std::span<const FloodPatch::Row> old_rows() const { return old_rows_.items(); }

private:
    static constexpr std::uint8_t locked = 1;
    static constexpr std::uint8_t kept = 2;

    // Whether a sample that arrives at a level would be among the K first.
    bool has_room(Index v, Index sample, std::uint32_t level) const {
        const std::size_t at = v * width_;
        const std::size_t count = lists_.count[v];
        if (count == width_) {
            const std::uint32_t last = lists_.distance[at + count - 1];
            if (last < level || (last == level && lists_.sample[at + count - 1] < sample)) return false;
        }
        const auto row = lists_.sample.begin() + static_cast<std::ptrdiff_t>(at);
        return std::find(row, row + static_cast<std::ptrdiff_t>(count), sample) ==
               row + static_cast<std::ptrdiff_t>(count);
    }

    void put_in(std::span<const Arrival> arrivals, std::uint32_t level, bool keep_old) {
        gained_.clear();
        workers_.for_chunks(arrivals.size(), 1024, [&](std::size_t begin, std::size_t end) {
            Gathered<Arrival>::Block gained(gained_);
            Gathered<FloodPatch::Row>::Block old(old_rows_);
            for (std::size_t i = begin; i < end; ++i) {
                const auto [v, sample] = arrivals[i];
                lock(v);
                if (has_room(v, sample, level)) {
                    if (keep_old) keep_row(v, old);
                    insert(v, sample, level);
                    gained.push(arrivals[i]);
                }
                unlock(v);
            }
        });
    }

    void insert(Index v, Index sample, std::uint32_t level) {
        Index* samples = lists_.sample.data() + v * width_;
        std::uint32_t* distances = lists_.distance.data() + v * width_;
        std::size_t at = lists_.count[v];
        if (at == width_)
            --at; // the last one goes
        else
            ++lists_.count[v];
        for (; at > 0; --at) {
            if (distances[at - 1] < level || (distances[at - 1] == level && samples[at - 1] < sample)) break;
            samples[at] = samples[at - 1];
            distances[at] = distances[at - 1];
        }
        samples[at] = sample;
        distances[at] = level;
    }

    void keep_row(Index v, Gathered<FloodPatch::Row>::Block& old) {
        std::atomic_ref state(state_[v]);
        if (state.load(std::memory_order_relaxed) & kept) return;
        state.fetch_or(kept, std::memory_order_relaxed);
        FloodPatch::Row row{v, lists_.count[v], {}, {}};
        std::copy_n(lists_.sample.begin() + static_cast<std::ptrdiff_t>(v * width_), width_, row.sample);
        std::copy_n(lists_.distance.begin() + static_cast<std::ptrdiff_t>(v * width_), width_, row.distance);
        old.push(row);
    }

    // Rows change only in put_in(), so here they are read without locks.
    void send_on(std::uint32_t level) {
        const std::span<const Arrival> gained = gained_.items();
        workers_.for_chunks(gained.size(), 512, [&](std::size_t begin, std::size_t end) {
            std::array<std::optional<Gathered<Arrival>::Block>, ring> blocks;
            for (std::size_t i = begin; i < end; ++i)
                for (Index link = graph_.first[gained[i].vertex]; link < graph_.first[gained[i].vertex + 1];
                     ++link) {
                    const Arrival next{graph_.neighbor[link], gained[i].sample};
                    const std::uint32_t when = level + lengths_[link];
                    if (!has_room(next.vertex, next.sample, when)) continue;
                    auto& block = blocks[when % ring];
                    if (!block) block.emplace(waiting_[when % ring]);
                    block->push(next);
                }
        });
    }

    void lock(Index v) {
        std::atomic_ref state(state_[v]);
        while (state.fetch_or(locked, std::memory_order_acquire) & locked) {
        }
    }
    void unlock(Index v) {
        std::atomic_ref(state_[v]).fetch_and(static_cast<std::uint8_t>(~locked), std::memory_order_release);
    }

    FloodLists& lists_;
    std::size_t width_;
    const Graph& graph_;
    std::span<const std::uint8_t> lengths_;
    Workers& workers_;
    std::vector<std::uint8_t> state_;             // of each vertex: locked, kept
    std::array<Gathered<Arrival>, ring> waiting_; // for each of the next levels
    Gathered<Arrival> gained_;                    // at the level at hand
    Gathered<FloodPatch::Row> old_rows_;
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

FloodLists flood(const Graph& graph, std::span<const std::uint8_t> lengths, std::span<const Index> samples,
                 std::size_t width, Workers& workers, Progress& progress) {
    require(width >= 1 && width <= influences_per_row, "a row has one to K places");
    FloodLists lists;
    lists.width = width;
    lists.sample.assign(graph.size() * width, no_index);
    lists.distance.assign(graph.size() * width, 0);
    lists.count.assign(graph.size(), 0);
    Flood(lists, graph, lengths, workers).run(samples, 0, false, progress);
    return lists;
}

FloodPatch add_samples(FloodLists& lists, const Graph& graph, std::span<const std::uint8_t> lengths,
                       std::span<const Index> added, Index first_new, Workers& workers, Progress& progress) {
    Flood flood(lists, graph, lengths, workers);
    flood.run(added, first_new, true, progress);
    return {{flood.old_rows().begin(), flood.old_rows().end()}};
}

void revert(FloodLists& lists, const FloodPatch& patch) {
    for (const FloodPatch::Row& row : patch.rows) {
        const auto at = static_cast<std::ptrdiff_t>(row.vertex * lists.width);
        lists.count[row.vertex] = row.count;
        std::copy_n(row.sample, lists.width, lists.sample.begin() + at);
        std::copy_n(row.distance, lists.width, lists.distance.begin() + at);
    }
}

} // namespace knead

#include "graph/symmetric_graph.h"

#include "base/error.h"
#include "base/large_pages.h"
#include "base/require.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>

namespace knead {

namespace {

constexpr std::size_t grain = 1024;

// Looks at all of a list, which is short: where to end early is what a processor guesses wrong.
bool names(std::span<const Index> list, Index vertex) {
    bool found = false;
    for (const Index other : list) found |= other == vertex;
    return found;
}

// Sorts entries that are pairwise different. Short rows by counting, for each, those that are lower: there is
// nothing to be guessed.
void sort_row(std::span<Index> row) {
    std::array<Index, 16> old;
    if (row.size() > old.size()) {
        std::ranges::sort(row);
        return;
    }
    std::ranges::copy(row, old.begin());
    for (std::size_t i = 0; i < row.size(); ++i) {
        std::size_t lower = 0;
        for (std::size_t j = 0; j < row.size(); ++j) lower += old[j] < old[i] ? 1 : 0;
        row[lower] = old[i];
    }
}

// Replaces counts by where each row begins; returns the total.
void counts_to_rows(std::vector<Index>& counts) {
    std::size_t total = 0;
    for (Index& entry : counts) {
        const std::size_t count = entry;
        entry = static_cast<Index>(total);
        total += count;
        if (total >= no_index)
            throw Error(Trouble::input, "",
                        "the cloud has too many points for so many neighbours each: knead takes " +
                            std::to_string(no_index - 1) + " links in all; cut it into pieces");
    }
}

} // namespace

Graph symmetric_graph(std::span<const Index> lists, std::size_t width, Workers& workers) {
    Graph graph;
    const std::size_t vertices = width == 0 ? 0 : lists.size() / width;
    graph.first = zeros_in_large_pages<Index>(vertices + 1, workers);
    const auto list = [&](std::size_t v) { return lists.subspan(v * width, width); };

    // Calls found(i, j) for every link i → j whose back link the lists lack.
    const auto for_missing_back_links = [&](auto&& found) {
        workers.for_each(vertices, grain, [&](std::size_t i) {
            for (const Index j : list(i))
                if (j != no_index && !names(list(j), static_cast<Index>(i))) found(static_cast<Index>(i), j);
        });
    };
    workers.for_each(vertices, grain, [&](std::size_t i) {
        graph.first[i] =
            static_cast<Index>(width - static_cast<std::size_t>(std::ranges::count(list(i), no_index)));
    });
    for_missing_back_links(
        [&](Index, Index j) { std::atomic_ref(graph.first[j]).fetch_add(1, std::memory_order_relaxed); });
    counts_to_rows(graph.first);

    resize_in_large_pages(graph.neighbor, graph.first.back(), workers);
    auto end = zeros_in_large_pages<Index>(vertices, workers);
    workers.for_each(vertices, grain, [&](std::size_t i) {
        Index at = graph.first[i];
        for (const Index j : list(i))
            if (j != no_index) graph.neighbor[at++] = j;
        end[i] = at;
    });
    for_missing_back_links([&](Index i, Index j) {
        graph.neighbor[std::atomic_ref(end[j]).fetch_add(1, std::memory_order_relaxed)] = i;
    });
    // Back links arrive in any order; sorted rows make the graph independent of it.
    workers.for_each(vertices, grain, [&](std::size_t v) {
        sort_row(std::span(graph.neighbor).subspan(graph.first[v], graph.first[v + 1] - graph.first[v]));
    });
    return graph;
}

Graph with_edges(const Graph& graph, std::span<const std::pair<Index, Index>> edges, Workers& workers) {
    // Rows with room for all, then each sorted and closed up.
    std::vector<Index> begin(graph.size() + 1, 0);
    for (std::size_t v = 0; v < graph.size(); ++v) begin[v] = graph.first[v + 1] - graph.first[v];
    for (const auto& [a, b] : edges) ++begin[a], ++begin[b];
    counts_to_rows(begin);
    std::vector<Index> end(begin.begin(), begin.end());
    std::vector<Index> all(begin.back());
    for (std::size_t v = 0; v < graph.size(); ++v)
        for (const Index u : graph.row(v)) all[end[v]++] = u;
    for (const auto& [a, b] : edges) {
        all[end[a]++] = b;
        all[end[b]++] = a;
    }
    Graph result;
    result.first.assign(graph.size() + 1, 0);
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        const std::span<Index> row = std::span(all).subspan(begin[v], end[v] - begin[v]);
        std::sort(row.begin(), row.end());
        result.first[v] = static_cast<Index>(std::unique(row.begin(), row.end()) - row.begin());
    });
    counts_to_rows(result.first);
    result.neighbor.resize(result.first.back());
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        const std::size_t count = result.first[v + 1] - result.first[v];
        std::ranges::copy(std::span(all).subspan(begin[v], count), result.neighbor.begin() + result.first[v]);
    });
    return result;
}

Graph rewired(const Graph& graph, std::span<const std::uint8_t> stays,
              std::span<const std::pair<Index, Index>> added, Workers& workers) {
    require(stays.size() == graph.neighbor.size(), "a word on every link");
    std::vector<std::pair<Index, Index>> both;
    both.reserve(2 * added.size());
    for (const auto& [a, b] : added) {
        both.emplace_back(a, b);
        both.emplace_back(b, a);
    }
    std::ranges::sort(both);
    both.erase(std::ranges::unique(both).begin(), both.end());
    const auto added_at = [&](std::size_t v) {
        return std::ranges::equal_range(both, static_cast<Index>(v), {}, &std::pair<Index, Index>::first);
    };

    Graph result;
    result.first.assign(graph.size() + 1, 0);
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        std::size_t count = added_at(v).size();
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link) count += stays[link] ? 1 : 0;
        result.first[v] = static_cast<Index>(count);
    });
    counts_to_rows(result.first);
    result.neighbor.resize(result.first.back());
    workers.for_each(graph.size(), grain, [&](std::size_t v) {
        Index at = result.first[v];
        for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link)
            if (stays[link]) result.neighbor[at++] = graph.neighbor[link];
        const auto more = added_at(v);
        if (more.empty()) return; // what stays ascends as it is
        for (const auto& link : more) result.neighbor[at++] = link.second;
        std::sort(result.neighbor.begin() + result.first[v], result.neighbor.begin() + at);
    });
    return result;
}

} // namespace knead

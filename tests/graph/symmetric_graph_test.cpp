#include "graph/clouds.h"
#include "graph/symmetric_graph.h"

#include <set>
#include <utility>

namespace knead {
namespace {

using Links = std::set<std::pair<Index, Index>>;

Links links_of(const Graph& graph) {
    Links links;
    for (Index v = 0; v < graph.size(); ++v)
        for (const Index u : graph.row(v)) links.insert({v, u});
    return links;
}

// `width` places a vertex, some of them empty.
std::vector<Index> random_lists(std::size_t vertices, std::size_t width, unsigned seed) {
    std::mt19937 random(seed);
    std::vector<Index> lists(vertices * width, no_index);
    for (std::size_t v = 0; v < vertices; ++v) {
        std::set<Index> chosen;
        for (std::size_t place = 0; place < width; ++place) {
            const auto other = static_cast<Index>(random() % vertices);
            if (other != v && random() % 4 != 0 && chosen.insert(other).second)
                lists[v * width + place] = other;
        }
    }
    return lists;
}

TEST(SymmetricGraph, HasEveryLinkAndItsWayBackAndNoOther) {
    for (const std::size_t width : {1U, 3U, 6U}) {
        const std::vector<Index> lists = random_lists(800, width, 1);
        test::Machine machine;
        const Graph graph = symmetric_graph(lists, width, machine.workers);
        test::expect_well_formed(graph);
        Links expected;
        for (std::size_t place = 0; place < lists.size(); ++place) {
            if (lists[place] == no_index) continue;
            const auto v = static_cast<Index>(place / width);
            expected.insert({v, lists[place]});
            expected.insert({lists[place], v});
        }
        EXPECT_EQ(links_of(graph), expected);
        EXPECT_EQ(graph.neighbor.size(), expected.size());
    }
}

TEST(SymmetricGraph, IsTheSameForAnyNumberOfThreads) {
    const std::vector<Index> lists = random_lists(30000, 4, 2);
    test::Machine one(1);
    const Graph expected = symmetric_graph(lists, 4, one.workers);
    for (const unsigned threads : {2U, 5U}) {
        test::Machine machine(threads);
        EXPECT_TRUE(test::same_graph(symmetric_graph(lists, 4, machine.workers), expected));
    }
}

TEST(SymmetricGraph, AcceptsEmptyLists) {
    test::Machine machine;
    EXPECT_EQ(symmetric_graph({}, 6, machine.workers).size(), 0U);
    const std::vector<Index> lists(12, no_index);
    const Graph graph = symmetric_graph(lists, 6, machine.workers);
    EXPECT_EQ(graph.size(), 2U);
    EXPECT_TRUE(graph.neighbor.empty());
}

TEST(WithEdges, AddsBothDirectionsOnce) {
    const Graph graph = test::cloud_of(test::random_positions(300, 3), 3).graph;
    std::vector<std::pair<Index, Index>> edges{{0, 299}, {299, 0}, {0, 299}, {17, 40}};
    const Index there = graph.row(5).front();
    edges.emplace_back(5, there);
    test::Machine machine;
    const Graph result = with_edges(graph, edges, machine.workers);
    test::expect_well_formed(result);
    Links expected = links_of(graph);
    for (const auto& [a, b] : edges) {
        expected.insert({a, b});
        expected.insert({b, a});
    }
    EXPECT_EQ(links_of(result), expected);
    EXPECT_EQ(result.neighbor.size(), expected.size());
    EXPECT_TRUE(test::same_graph(with_edges(graph, {}, machine.workers), graph));
}

} // namespace
} // namespace knead

#include "graph/algorithm1.h"
#include "graph/clouds.h"
#include "graph/flood.h"

#include "graph/link_lengths.h"
#include "graph/shortest_ways.h"

#include <set>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

InfluenceRows flooded(const Cloud& cloud, std::span<const std::uint8_t> lengths,
                      const std::vector<Index>& samples, unsigned threads = 2) {
    Machine machine(threads);
    return flood(cloud.graph, lengths, samples, machine.workers, machine.progress);
}

// The same values, be the rows narrow or wide.
bool same_rows(const InfluenceRows& a, const InfluenceRows& b) {
    for (std::size_t v = 0; v < a.size() && v < b.size(); ++v)
        if (a[v].sample != b[v].sample || a[v].distance != b[v].distance) return false;
    return a.size() == b.size();
}

// Whose rows a patch keeps.
std::vector<Index> vertices_of(const FloodPatch& patch) {
    std::vector<Index> vertices;
    const auto collect = [&](const auto& blocks) {
        for (const auto& block : blocks) block.each([&](const auto& old) { vertices.push_back(old.vertex); });
    };
    std::visit(collect, patch.blocks);
    return vertices;
}

// Puts the rows that a patch keeps where they were, in rows that may have become wide since.
template<std::size_t places>
void put_back(const RowPatch<places>& patch, NearestRows<places>& nearest) {
    std::visit(
        []<typename Row, typename Old>(std::vector<Row>& rows, const std::vector<Pile<OldRow<Old>>>& blocks) {
            for (const auto& block : blocks)
                block.each([&](const OldRow<Old>& old) {
                    const Old row{old.sample, old.distance};
                    if constexpr (std::is_same_v<Row, Old>)
                        rows[old.vertex] = row;
                    else if constexpr (sizeof(Row) > sizeof(Old))
                        rows[old.vertex] = widened(row);
                    else
                        FAIL() << "rows do not become narrow again";
                });
        },
        nearest.rows, patch.blocks);
}

void expect_reached(const WideRow& row, const std::vector<test::Reached>& expected, Index vertex) {
    ASSERT_EQ(row.count(), expected.size()) << "at vertex " << vertex;
    for (std::size_t place = 0; place < expected.size(); ++place) {
        ASSERT_EQ(row.sample.at(place), expected[place].sample) << "vertex " << vertex << " place " << place;
        ASSERT_EQ(row.distance.at(place), expected[place].hops) << "vertex " << vertex << " place " << place;
    }
    for (std::size_t place = expected.size(); place < influences_per_row; ++place)
        ASSERT_EQ(row.sample.at(place), no_index);
}

TEST(Flood, IsAlgorithm1WhereEveryLinkIsOneLong) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        for (const std::size_t count : {1U, 5U, 40U, 200U}) {
            const std::vector<Index> samples = test::random_vertices(cloud.size(), count, 1);
            const auto nearest = flooded(cloud, cloud.hops(), samples);
            ASSERT_EQ(nearest.size(), cloud.size());
            for (Index v = 0; v < cloud.size(); ++v)
                expect_reached(nearest[v], test::algorithm1(cloud.graph, samples, v), v);
        }
    }
}

TEST(Flood, IsADijkstraSearchOfEveryVertexWhereLinksHaveLengths) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        for (const std::size_t count : {5U, 40U, 200U}) {
            const std::vector<Index> samples = test::random_vertices(cloud.size(), count, 2);
            const auto nearest = flooded(cloud, cloud.lengths, samples);
            for (Index v = 0; v < cloud.size(); ++v)
                expect_reached(nearest[v], test::nearest_by_length(cloud.graph, cloud.lengths, samples, v),
                               v);
        }
    }
}

TEST(Flood, TakesLinksOfEveryLength) {
    // In several tiles.
    const Cloud cloud = test::cloud_of(test::random_positions(3000, 5));
    std::vector<std::uint8_t> lengths(cloud.graph.neighbor.size());
    std::mt19937 random(1);
    for (Index v = 0; v < cloud.size(); ++v) {
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link) {
            const Index u = cloud.graph.neighbor[link];
            if (u < v) continue;
            const auto length =
                static_cast<std::uint8_t>(random() % 3 == 0 ? longest_link : 1 + random() % longest_link);
            lengths[link] = lengths[*find_link(cloud.graph, u, v)] = length;
        }
    }
    const std::vector<Index> samples = test::random_vertices(cloud.size(), 12, 3);
    const auto nearest = flooded(cloud, lengths, samples);
    for (Index v = 0; v < cloud.size(); ++v)
        expect_reached(nearest[v], test::nearest_by_length(cloud.graph, lengths, samples, v), v);
}

// A vertex with so many chains of one to five vertices.
Graph hub_graph(Index chains) {
    std::vector<std::set<Index>> links(1);
    for (Index chain = 0; chain < chains; ++chain) {
        Index last = 0;
        for (Index way = 0; way <= chain % 5; ++way) {
            const auto next = static_cast<Index>(links.size());
            links.push_back({last});
            links[last].insert(next);
            last = next;
        }
    }
    Graph graph;
    graph.first.push_back(0);
    for (const auto& row : links) {
        graph.neighbor.insert(graph.neighbor.end(), row.begin(), row.end());
        graph.first.push_back(static_cast<Index>(graph.neighbor.size()));
    }
    return graph;
}

TEST(Flood, PassesOnByAnyNumberOfLinks) {
    for (const Index chains : {1U, 31U, 32U, 33U, 64U, 65U, 100U, 3000U}) { // of the last most in other tiles
        SCOPED_TRACE(chains);
        const Graph graph = hub_graph(chains);
        std::vector<std::uint8_t> lengths(graph.neighbor.size());
        for (Index v = 0; v < graph.size(); ++v)
            for (Index link = graph.first[v]; link < graph.first[v + 1]; ++link)
                lengths[link] = static_cast<std::uint8_t>(1 + (v + graph.neighbor[link]) % longest_link);
        const std::vector<Index> samples =
            test::random_vertices(graph.size(), std::min<std::size_t>(graph.size() / 2 + 1, 20), 3);
        Machine machine;
        const auto nearest = flood(graph, lengths, samples, machine.workers, machine.progress);
        const auto territory = territories(graph, lengths, samples, machine.workers, machine.progress);
        const Index step = graph.size() > 1000 ? 53 : 1;
        for (Index v = 0; v < graph.size(); v += step) {
            const auto expected = test::nearest_by_length(graph, lengths, samples, v);
            expect_reached(nearest[v], expected, v);
            ASSERT_EQ(territory[v], expected[0].sample) << v;
        }
    }
}

TEST(Territories, AreTheNearestSample) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        Machine machine;
        for (const auto& lengths : {cloud.hops(), cloud.lengths}) {
            const std::vector<Index> samples = test::random_vertices(cloud.size(), 25, 4);
            const auto nearest =
                territories(cloud.graph, lengths, samples, machine.workers, machine.progress);
            ASSERT_EQ(nearest.size(), cloud.size());
            for (Index v = 0; v < cloud.size(); ++v) {
                const auto expected = test::nearest_by_length(cloud.graph, lengths, samples, v, 1);
                ASSERT_EQ(nearest[v], expected.empty() ? no_index : expected[0].sample);
            }
        }
    }
}

TEST(Flood, IsTheSameSearchAcrossItsTiles) {
    for (const Shape shape : {Shape::knot, Shape::plane}) {
        const Cloud cloud = test::cloud_of(test::shape_positions(shape, 20'000)); // ten tiles
        for (const std::size_t count : {5U, 40U, 400U, 3000U}) {
            const std::vector<Index> samples = test::random_vertices(cloud.size(), count, 9);
            const auto nearest = flooded(cloud, cloud.lengths, samples);
            for (Index v = 0; v < cloud.size(); v += count < 40 ? 997 : 97)
                expect_reached(nearest[v], test::nearest_by_length(cloud.graph, cloud.lengths, samples, v),
                               v);
        }
    }
}

TEST(Flood, AddsSamplesAsIfTheyHadBeenThereAndTakesThemBack) {
    auto clouds = test::several_clouds();
    clouds.push_back({"of several tiles", test::cloud_of(test::shape_positions(Shape::knot, 20'000))});
    for (const auto& [name, cloud] : clouds) {
        SCOPED_TRACE(name);
        for (const std::size_t base : {0U, 3U, 60U}) {
            const std::vector<Index> samples = test::random_vertices(cloud.size(), base + 20, 6);
            const std::vector<Index> old(samples.begin(), samples.begin() + static_cast<int>(base));
            const std::vector<Index> added(samples.begin() + static_cast<int>(base), samples.end());
            const auto before = flooded(cloud, cloud.lengths, old);
            auto nearest = before;
            Machine machine;
            const FloodPatch patch =
                add_starts(nearest, cloud.graph, cloud.lengths, starts_of(added, static_cast<Index>(base)),
                           machine.workers, machine.progress);
            EXPECT_TRUE(same_rows(nearest, flooded(cloud, cloud.lengths, samples)));

            const std::vector<Index> patched = vertices_of(patch);
            EXPECT_EQ(std::set<Index>(patched.begin(), patched.end()).size(), patched.size())
                << "a row was kept twice";
            put_back(patch, nearest);
            EXPECT_TRUE(same_rows(nearest, before));
        }
    }
}

// More levels between the nearest and the farthest start than can wait at a time.
TEST(Flood, StartsAtAnyDistance) {
    const Graph graph{{0, 0, 1, 2}, {2, 1}}; // one vertex alone, two that are linked
    const std::vector<std::uint8_t> lengths{5, 5};
    Machine machine;
    for (Index distance = 0; distance < 2100; ++distance) {
        InfluenceRows nearest = flood(graph, lengths, {}, machine.workers, machine.progress);
        const std::vector<FloodStart> starts{{0, 0, 0}, {1, 1, distance}};
        add_starts(nearest, graph, lengths, starts, machine.workers, machine.progress);
        expect_reached(nearest[0], {{0, 0}}, 0);
        expect_reached(nearest[2], {{distance + 5, 1}}, 2);
    }
}

TEST(Flood, IsASearchFromEveryStart) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 20'000)); // ten tiles
    std::mt19937 random(7);
    std::vector<FloodStart> starts = starts_of(test::random_vertices(cloud.size(), 30, 5), 0);
    std::vector<std::vector<test::Reached>> expected(cloud.size());
    for (FloodStart& start : starts) {
        start.distance = static_cast<Index>(random() % 1000);
        const std::vector<Index> way = test::ways_from(cloud.graph, cloud.lengths, start.vertex);
        for (Index v = 0; v < cloud.size(); ++v)
            if (way[v] != no_index) expected[v].push_back({start.distance + way[v], start.number});
    }
    InfluenceRows nearest = flooded(cloud, cloud.lengths, {});
    Machine machine;
    add_starts(nearest, cloud.graph, cloud.lengths, starts, machine.workers, machine.progress);
    for (Index v = 0; v < cloud.size(); ++v) {
        std::ranges::sort(expected[v]);
        if (expected[v].size() > influences_per_row) expected[v].resize(influences_per_row);
        expect_reached(nearest[v], expected[v], v);
    }
}

TEST(Flood, AddsTerritoriesAsAllOfItWould) {
    auto clouds = test::several_clouds();
    clouds.push_back({"of several tiles", test::cloud_of(test::shape_positions(Shape::knot, 20'000))});
    for (const auto& [name, cloud] : clouds)
        for (const std::size_t base : {0U, 3U, 60U}) {
            SCOPED_TRACE(name + ", " + std::to_string(base));
            const std::vector<Index> samples = test::random_vertices(cloud.size(), base + 20, 6);
            const std::vector<Index> old(samples.begin(), samples.begin() + static_cast<int>(base));
            const std::vector<Index> added(samples.begin() + static_cast<int>(base), samples.end());
            Machine machine;
            TerritoryRows nearest = territory_rows(flooded(cloud, cloud.lengths, old), machine.workers);
            const auto expect_first_of = [&](const InfluenceRows& rows) {
                for (Index v = 0; v < cloud.size(); ++v) {
                    ASSERT_EQ(nearest[v].sample[0], rows[v].sample[0]) << v;
                    ASSERT_EQ(nearest[v].distance[0], rows[v].distance[0]) << v;
                }
            };
            const TerritoryPatch patch =
                add_starts(nearest, cloud.graph, cloud.lengths, starts_of(added, static_cast<Index>(base)),
                           machine.workers, machine.progress);
            expect_first_of(flooded(cloud, cloud.lengths, samples));
            put_back(patch, nearest);
            expect_first_of(flooded(cloud, cloud.lengths, old));
        }
}

TEST(Flood, StartsFromSeveralVerticesAsFromTheNearestOfThem) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 20'000));
    const std::vector<Index> samples = test::random_vertices(cloud.size(), 40, 9);
    const std::vector<Index> ones = test::random_vertices(cloud.size(), 60, 10);
    std::vector<FloodStart> starts;
    for (std::size_t i = 0; i < ones.size(); ++i)
        starts.push_back({ones[i], static_cast<Index>(i < 50 ? 40 : 41)}); // 50 of one, 10 of another
    const auto before = flooded(cloud, cloud.lengths, samples);
    auto nearest = before;
    Machine machine;
    const FloodPatch patch =
        add_starts(nearest, cloud.graph, cloud.lengths, starts, machine.workers, machine.progress);
    // From every vertex: what the 100 starts are apart, of each number the nearest.
    std::vector<Index> all = samples;
    for (const FloodStart& start : starts) all.push_back(start.vertex);
    for (Index v = 0; v < cloud.size(); v += 97) {
        std::vector<test::Reached> expected;
        for (test::Reached reached :
             test::nearest_by_length(cloud.graph, cloud.lengths, all, v, all.size())) {
            if (reached.sample >= 40) reached.sample = starts[reached.sample - 40].number;
            if (std::ranges::find(expected, reached.sample, &test::Reached::sample) == expected.end())
                expected.push_back(reached);
        }
        std::ranges::sort(expected, {}, [](const auto& each) { return std::pair(each.hops, each.sample); });
        expected.resize(std::min(expected.size(), influences_per_row));
        expect_reached(nearest[v], expected, v);
    }
    put_back(patch, nearest);
    EXPECT_TRUE(same_rows(nearest, before));
}

TEST(Flood, LeavesFarRowsAloneWhenASampleIsAdded) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 5000));
    std::vector<Index> samples = test::random_vertices(cloud.size(), 501, 7);
    const std::vector<Index> added{samples.back()};
    samples.pop_back();
    auto nearest = flooded(cloud, cloud.lengths, samples);
    Machine machine;
    const FloodPatch patch = add_starts(nearest, cloud.graph, cloud.lengths, starts_of(added, 500),
                                        machine.workers, machine.progress);
    // A sample is among the nearest 8 of about 8 / 501 of the vertices; a tenth leaves room for its place.
    EXPECT_GT(vertices_of(patch).size(), 0U);
    EXPECT_LT(vertices_of(patch).size(), cloud.size() / 10);
}

TEST(Flood, IsTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 20000));
    const std::vector<Index> samples = test::random_vertices(cloud.size(), 400, 8);
    const std::vector<Index> added = [&] {
        std::vector<Index> more = test::random_vertices(cloud.size(), 440, 8); // the same 400 first
        more.erase(more.begin(), more.begin() + 400);
        return more;
    }();
    std::vector<InfluenceRows> results;
    std::vector<std::vector<Index>> nearest_only;
    for (const unsigned threads : {1U, 2U, 5U}) {
        Machine machine(threads);
        results.push_back(flooded(cloud, cloud.lengths, samples, threads));
        add_starts(results.back(), cloud.graph, cloud.lengths, starts_of(added, 400), machine.workers,
                   machine.progress);
        nearest_only.push_back(
            territories(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress));
    }
    EXPECT_TRUE(same_rows(results[0], results[1]));
    EXPECT_TRUE(same_rows(results[0], results[2]));
    EXPECT_EQ(nearest_only[0], nearest_only[1]);
    EXPECT_EQ(nearest_only[0], nearest_only[2]);
}

TEST(Flood, LeavesComponentsWithoutSamplesEmpty) {
    const Cloud cloud = test::cloud_of(test::two_patches(false));
    std::vector<Index> samples;
    for (Index v = 0; v < cloud.size() && samples.size() < 12; ++v)
        if (cloud.components.component[v] == 0) samples.push_back(v);
    const auto nearest = flooded(cloud, cloud.lengths, samples);
    for (Index v = 0; v < cloud.size(); ++v)
        EXPECT_EQ(nearest[v].count(), cloud.components.component[v] == 0 ? influences_per_row : 0U);
    EXPECT_EQ(flooded(cloud, cloud.lengths, {})[0].count(), 0U);
}

TEST(Flood, AcceptsAnEmptyGraph) {
    const Cloud cloud = test::cloud_of({});
    EXPECT_EQ(flooded(cloud, cloud.lengths, {}).size(), 0U);
}

// A chain of so many vertices, every link as long as can be, with samples at its first ones.
struct Chain {
    Graph graph;
    std::vector<std::uint8_t> lengths;
    std::vector<Index> samples;

    Chain(Index vertices, Index sample_count) {
        graph.first.push_back(0);
        for (Index v = 0; v < vertices; ++v) {
            if (v > 0) graph.neighbor.push_back(v - 1);
            if (v + 1 < vertices) graph.neighbor.push_back(v + 1);
            graph.first.push_back(static_cast<Index>(graph.neighbor.size()));
        }
        lengths.assign(graph.neighbor.size(), longest_link);
        for (Index s = 0; s < sample_count; ++s) samples.push_back(s);
    }

    // Sample s is |v - s| links away.
    void expect_exact(const InfluenceRows& nearest) const {
        for (Index v = 0; v < graph.size(); ++v) {
            const WideRow row = nearest[v];
            ASSERT_EQ(row.count(), std::min<std::size_t>(samples.size(), influences_per_row));
            for (std::size_t k = 0; k < row.count(); ++k) {
                const Index s = row.sample.at(k);
                ASSERT_EQ(row.distance.at(k), longest_link * (v > s ? v - s : s - v)) << v;
            }
        }
    }
};

TEST(Flood, WidensRowsForWaysThatNarrowOnesCannotTell) {
    Machine machine;
    // 65,535 levels are 257 links.
    for (const auto& [vertices, wide] :
         {std::pair{250U, false}, std::pair{270U, true}, std::pair{9000U, true}}) {
        const Chain chain(vertices, 3);
        const InfluenceRows nearest =
            flood(chain.graph, chain.lengths, chain.samples, machine.workers, machine.progress);
        EXPECT_EQ(nearest.are_wide(), wide) << vertices;
        chain.expect_exact(nearest);
        const std::vector<Index> all_nearest =
            territories(chain.graph, chain.lengths, chain.samples, machine.workers, machine.progress);
        for (Index v = 0; v < vertices; ++v) ASSERT_EQ(all_nearest[v], std::min(v, 2U));
    }
}

TEST(Flood, WidensRowsWhenAnAddedSampleIsTooFarForThem) {
    Machine machine;
    Chain chain(5000, 0);
    chain.samples = {0};
    // Nothing reaches far yet: the only sample stands apart from the chain's rest.
    chain.lengths.assign(chain.graph.neighbor.size(), 1);
    InfluenceRows nearest =
        flood(chain.graph, chain.lengths, chain.samples, machine.workers, machine.progress);
    const InfluenceRows before = nearest;
    ASSERT_FALSE(nearest.are_wide());
    chain.lengths.assign(chain.graph.neighbor.size(), longest_link);
    const std::vector<Index> added{4999};
    const FloodPatch patch = add_starts(nearest, chain.graph, chain.lengths, starts_of(added, 1),
                                        machine.workers, machine.progress);
    EXPECT_TRUE(nearest.are_wide());
    for (Index v = 0; v < 5000; ++v) {
        const WideRow row = nearest[v];
        ASSERT_EQ(row.count(), 2U);
        for (std::size_t k = 0; k < 2; ++k)
            ASSERT_EQ(row.distance.at(k), row.sample.at(k) == 0 ? v : longest_link * (4999 - v));
    }
    put_back(patch, nearest);
    EXPECT_TRUE(same_rows(nearest, before));
    EXPECT_TRUE(nearest.are_wide());
}

TEST(Flood, WidensRowsWhenThereAreMoreSamplesThanNarrowOnesCount) {
    Machine machine;
    Chain chain(66'000, 65'534);
    chain.lengths.assign(chain.graph.neighbor.size(), 5);
    InfluenceRows nearest =
        flood(chain.graph, chain.lengths, chain.samples, machine.workers, machine.progress);
    EXPECT_FALSE(nearest.are_wide());
    const InfluenceRows before = nearest;
    const std::vector<Index> added{65'534, 65'535};
    const FloodPatch patch = add_starts(nearest, chain.graph, chain.lengths, starts_of(added, 65'534),
                                        machine.workers, machine.progress);
    EXPECT_TRUE(nearest.are_wide());
    chain.samples.insert(chain.samples.end(), added.begin(), added.end());
    const InfluenceRows all =
        flood(chain.graph, chain.lengths, chain.samples, machine.workers, machine.progress);
    EXPECT_TRUE(all.are_wide());
    EXPECT_TRUE(same_rows(nearest, all));
    EXPECT_EQ(all[65'999].sample[0], 65'535U);
    put_back(patch, nearest);
    EXPECT_TRUE(same_rows(nearest, before));
}

TEST(LinkLengths, FollowTheLengthOfTheLinks) {
    const Cloud cloud = test::cloud_of(test::random_positions(2000, 9));
    std::vector<double> ratio; // of levels to length: the same for all links up to rounding and the ends
    for (Index v = 0; v < cloud.size(); ++v) {
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link) {
            const Index u = cloud.graph.neighbor[link];
            const int levels = cloud.lengths[link];
            ASSERT_EQ(levels, cloud.lengths[*find_link(cloud.graph, u, v)]);
            ASSERT_GE(levels, 1);
            ASSERT_LE(levels, int{longest_link});
            if (levels > 23 && levels < int{longest_link})
                ratio.push_back(levels / (cloud.at(v) - cloud.at(u)).norm());
        }
    }
    // From 24 levels on, rounding by half a level is a 48th at most.
    const auto [least, most] = std::ranges::minmax(ratio);
    EXPECT_GT(ratio.size(), 100U);
    EXPECT_LT(most / least, (1 + 1.0 / 47) / (1 - 1.0 / 49));
}

TEST(LinkLengths, DoNotDependOnTheUnit) {
    const std::vector<float> positions = test::shape_positions(Shape::creature, 2000);
    std::vector<float> scaled = positions;
    for (float& value : scaled) value = std::ldexp(value, 90);
    EXPECT_EQ(test::cloud_of(scaled).lengths, test::cloud_of(positions).lengths);
}

} // namespace
} // namespace knead

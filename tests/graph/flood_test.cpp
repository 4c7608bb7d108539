#include "graph/algorithm1.h"
#include "graph/clouds.h"
#include "graph/flood.h"
#include "graph/shortest_ways.h"

#include <set>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;

std::vector<NearestSamples> flooded(const Cloud& cloud, std::span<const std::uint8_t> lengths,
                                    const std::vector<Index>& samples, unsigned threads = 2) {
    Machine machine(threads);
    return flood(cloud.graph, lengths, samples, machine.workers, machine.progress);
}

bool same_row(const NearestSamples& a, const NearestSamples& b) {
    return a.sample == b.sample && a.distance == b.distance;
}

bool same_rows(const std::vector<NearestSamples>& a, const std::vector<NearestSamples>& b) {
    return std::ranges::equal(a, b, same_row);
}

void expect_reached(const NearestSamples& row, const std::vector<test::Reached>& expected, Index vertex) {
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
    // Lengths from 1 to 63 at random: one level more would overtake the ring of waiting levels.
    const Cloud cloud = test::cloud_of(test::random_positions(600, 5));
    std::vector<std::uint8_t> lengths(cloud.graph.neighbor.size());
    std::mt19937 random(1);
    for (Index v = 0; v < cloud.size(); ++v) {
        for (Index link = cloud.graph.first[v]; link < cloud.graph.first[v + 1]; ++link) {
            const Index u = cloud.graph.neighbor[link];
            if (u < v) continue;
            const auto length = static_cast<std::uint8_t>(random() % 3 == 0 ? 63 : 1 + random() % 63);
            lengths[link] = lengths[*find_link(cloud.graph, u, v)] = length;
        }
    }
    const std::vector<Index> samples = test::random_vertices(cloud.size(), 12, 3);
    const auto nearest = flooded(cloud, lengths, samples);
    for (Index v = 0; v < cloud.size(); ++v)
        expect_reached(nearest[v], test::nearest_by_length(cloud.graph, lengths, samples, v), v);
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
        const Cloud cloud = test::cloud_of(test::shape_positions(shape, 20'000)); // five tiles
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
            const FloodPatch patch = add_samples(nearest, cloud.graph, cloud.lengths, added,
                                                 static_cast<Index>(base), machine.workers, machine.progress);
            EXPECT_TRUE(same_rows(nearest, flooded(cloud, cloud.lengths, samples)));

            std::set<Index> patched;
            for (const auto& row : patch.rows) patched.insert(row.vertex);
            EXPECT_EQ(patched.size(), patch.rows.size()) << "a row was kept twice";
            revert(nearest, patch);
            EXPECT_TRUE(same_rows(nearest, before));
        }
    }
}

TEST(Flood, LeavesFarRowsAloneWhenASampleIsAdded) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::plane, 5000));
    std::vector<Index> samples = test::random_vertices(cloud.size(), 501, 7);
    const std::vector<Index> added{samples.back()};
    samples.pop_back();
    auto nearest = flooded(cloud, cloud.lengths, samples);
    Machine machine;
    const FloodPatch patch =
        add_samples(nearest, cloud.graph, cloud.lengths, added, 500, machine.workers, machine.progress);
    // A sample is among the nearest 8 of about 8 / 501 of the vertices; a tenth leaves room for its place.
    EXPECT_GT(patch.rows.size(), 0U);
    EXPECT_LT(patch.rows.size(), cloud.size() / 10);
}

TEST(Flood, IsTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 20000));
    const std::vector<Index> samples = test::random_vertices(cloud.size(), 400, 8);
    const std::vector<Index> added = [&] {
        std::vector<Index> more = test::random_vertices(cloud.size(), 440, 8); // the same 400 first
        more.erase(more.begin(), more.begin() + 400);
        return more;
    }();
    std::vector<std::vector<NearestSamples>> results;
    std::vector<std::vector<Index>> nearest_only;
    for (const unsigned threads : {1U, 2U, 5U}) {
        Machine machine(threads);
        results.push_back(flooded(cloud, cloud.lengths, samples, threads));
        add_samples(results.back(), cloud.graph, cloud.lengths, added, 400, machine.workers,
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
    EXPECT_TRUE(flooded(cloud, cloud.lengths, {}).empty());
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
            ASSERT_LE(levels, 63);
            if (levels > 5 && levels < 63) ratio.push_back(levels / (cloud.at(v) - cloud.at(u)).norm());
        }
    }
    // From six levels on, rounding by half a level is a twelfth at most.
    const auto [least, most] = std::ranges::minmax(ratio);
    EXPECT_GT(ratio.size(), 100U);
    EXPECT_LT(most / least, (1 + 1.0 / 11) / (1 - 1.0 / 13));
}

TEST(LinkLengths, DoNotDependOnTheUnit) {
    const std::vector<float> positions = test::shape_positions(Shape::creature, 2000);
    std::vector<float> scaled = positions;
    for (float& value : scaled) value = std::ldexp(value, 90);
    EXPECT_EQ(test::cloud_of(scaled).lengths, test::cloud_of(positions).lengths);
}

TEST(Shuffled, IsAPermutationThatDependsOnTheNumbersAlone) {
    std::vector<Index> vertices(1000);
    for (Index v = 0; v < 1000; ++v) vertices[v] = 7 * v;
    const std::vector<Index> once = shuffled(vertices);
    EXPECT_FALSE(std::ranges::is_sorted(once));
    EXPECT_TRUE(std::ranges::is_permutation(once, vertices));
    std::ranges::reverse(vertices);
    EXPECT_EQ(shuffled(vertices), once);
}

} // namespace
} // namespace knead

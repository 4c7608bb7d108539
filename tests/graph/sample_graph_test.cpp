#include "graph/clouds.h"
#include "graph/sampling.h"

#include <map>
#include <numeric>
#include <set>

namespace knead {
namespace {

using test::Cloud;
using test::Machine;
using test::octree_of;
using test::shuffled_in_runs;

struct Sampled {
    std::vector<Index> samples;
    InfluenceRows nearest;
    SampleGraph graph;
};

Sampled sampled(const Cloud& cloud, const std::vector<Index>& samples, unsigned threads = 2) {
    Machine machine(threads);
    Sampled result;
    result.samples = samples;
    result.nearest = flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
    result.graph = sample_graph(result.nearest, samples, cloud.graph, machine.workers);
    return result;
}

// Two samples hang together exactly if their vertices do.
void expect_same_components(const Cloud& cloud, const Sampled& sampled) {
    const Components components = test::components_of(sampled.graph.graph);
    std::map<Index, Index> seen; // of each component of the points: that of its samples
    std::set<Index> used;
    for (std::size_t s = 0; s < sampled.samples.size(); ++s) {
        const Index of_point = cloud.components.component[sampled.samples[s]];
        const auto [found, is_first] = seen.insert({of_point, components.component[s]});
        ASSERT_EQ(found->second, components.component[s]) << "the samples of a component fell apart";
        const bool is_new = used.insert(components.component[s]).second;
        ASSERT_EQ(is_new, is_first) << "two components were joined";
    }
}

void expect_contacts(const SampleGraph& graph) {
    ASSERT_EQ(graph.contact.size(), graph.graph.neighbor.size());
    for (Index v = 0; v < graph.graph.size(); ++v) {
        for (Index link = graph.graph.first[v]; link < graph.graph.first[v + 1]; ++link) {
            ASSERT_GT(graph.contact[link], 0.0F);
            ASSERT_EQ(graph.contact[link],
                      graph.contact[*find_link(graph.graph, graph.graph.neighbor[link], v)]);
        }
    }
}

TEST(SampleGraph, HangsTogetherAsThePointsDo) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        for (const std::size_t count : {1U, 2U, 12U, 100U}) {
            const Sampled result = sampled(cloud, shuffled_in_runs(octree_of(cloud, count)));
            ASSERT_EQ(result.graph.graph.size(), count);
            test::expect_well_formed(result.graph.graph);
            expect_contacts(result.graph);
            expect_same_components(cloud, result);
        }
    }
}

// The graph of these samples where those from number `base` on were added to the flood of the others.
SampleGraph with_added(const Cloud& cloud, const std::vector<Index>& samples, std::size_t base) {
    Machine machine;
    const std::span all(samples);
    const InfluenceRows nearest =
        flood(cloud.graph, cloud.lengths, all.first(base), machine.workers, machine.progress);
    TerritoryRows territory = territory_rows(nearest, machine.workers);
    const auto before = territory_borders(territory, cloud.graph, machine.workers);
    const auto first_added = static_cast<Index>(base);
    AddedStarts<1> added = no_starts(territory, first_added);
    const TerritoryPatch patch = change_starts(added, starts_of(all.subspan(base), first_added), territory,
                                               cloud.graph, cloud.lengths, machine.workers, machine.progress);
    const auto borders =
        territory_borders_after(before, patch, added, territory, cloud.graph, cloud.lengths, machine.workers);
    return sample_graph(rows_at(nearest, samples), borders, machine.workers);
}

// But for a few: of two added samples it is known only how far they are from each other if their territories
// touch.
TEST(SampleGraph, LinksAddedSamplesAsIfTheyHadBeenThere) {
    for (const auto& [name, cloud] : test::several_clouds()) {
        SCOPED_TRACE(name);
        const std::vector<Index> samples = shuffled_in_runs(octree_of(cloud, 100));
        const SampleGraph at_once = sampled(cloud, samples).graph;
        const SampleGraph later = with_added(cloud, samples, samples.size() * 9 / 10);
        test::expect_well_formed(later.graph);
        expect_contacts(later);
        const auto missing_in = [&](const SampleGraph& one, const SampleGraph& other) {
            std::size_t missing = 0;
            for (Index s = 0; s < samples.size(); ++s)
                for (Index link = one.graph.first[s]; link < one.graph.first[s + 1]; ++link) {
                    const auto same = find_link(other.graph, s, one.graph.neighbor[link]);
                    missing += same ? 0 : 1;
                    if (same) {
                        EXPECT_EQ(one.contact[link], other.contact[*same]);
                    }
                }
            return missing;
        };
        // Of ten added samples there may be a pair or two, and each pair is two links of some 700.
        constexpr std::size_t one_in = 60;
        EXPECT_LT(one_in * missing_in(later, at_once), at_once.graph.neighbor.size());
        EXPECT_LT(one_in * missing_in(at_once, later), at_once.graph.neighbor.size());
    }
}

TEST(SampleGraph, CrossesAThinNeck) {
    // Ten samples crowd on each patch and none is on the neck: the six nearest of each are on its own side.
    const Cloud cloud = test::cloud_of(test::two_patches(true));
    ASSERT_EQ(cloud.components.size.size(), 1U);
    const double middle = 0.5 * (cloud.at(0).x() + cloud.at(cloud.size() - 1).x());
    std::vector<Index> left;
    std::vector<Index> right;
    for (Index v = 0; v < cloud.size(); ++v) {
        if (cloud.at(v).x() < middle - 10 && left.size() < 10) left.push_back(v);
        if (cloud.at(v).x() > middle + 10 && right.size() < 10) right.push_back(v);
    }
    std::vector<Index> samples = left;
    samples.insert(samples.end(), right.begin(), right.end());
    ASSERT_EQ(samples.size(), 20U);
    const Sampled result = sampled(cloud, samples);
    for (std::size_t s = 0; s < samples.size(); ++s)
        for (std::size_t place = 0; place <= sample_neighbors; ++place)
            EXPECT_EQ(result.nearest[samples[s]].sample.at(place) < 10, s < 10)
                << "the test means the nearest to be on one side";
    expect_same_components(cloud, result);
    EXPECT_EQ(test::components_of(result.graph.graph).size.size(), 1U);
}

TEST(SampleGraph, LinksTheNearestAndWhatTouches) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::creature, 4000));
    const Sampled result = sampled(cloud, shuffled_in_runs(octree_of(cloud, 150)));
    const Graph& graph = result.graph.graph;
    std::map<std::pair<Index, Index>, float> crossing;
    for (Index v = 0; v < cloud.size(); ++v) {
        const Index a = result.nearest[v].sample[0];
        if (a == no_index) continue;
        for (const Index u : cloud.graph.row(v)) {
            const Index b = result.nearest[u].sample[0];
            if (a != b) crossing[{a, b}] += 1;
        }
    }
    std::set<std::pair<Index, Index>> expected;
    for (Index s = 0; s < result.samples.size(); ++s) {
        const WideRow row = result.nearest[result.samples[s]];
        ASSERT_EQ(row.sample[0], s);
        for (std::size_t place = 1; place <= sample_neighbors && row.sample.at(place) != no_index; ++place) {
            expected.insert({s, row.sample.at(place)});
            expected.insert({row.sample.at(place), s});
        }
    }
    for (const auto& [pair, links] : crossing) expected.insert(pair);
    EXPECT_EQ(graph.neighbor.size(), expected.size());
    for (const auto& [a, b] : expected) {
        const auto link = find_link(graph, a, b);
        ASSERT_TRUE(link.has_value()) << a << " and " << b;
        const auto found = crossing.find({a, b});
        EXPECT_EQ(result.graph.contact[*link], found == crossing.end() ? 0.5F : found->second);
    }
}

TEST(SampleGraph, IsTheSameForAnyNumberOfThreads) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::knot, 10000));
    const std::vector<Index> samples = shuffled_in_runs(octree_of(cloud, 2500));
    const Sampled one = sampled(cloud, samples, 1);
    for (const unsigned threads : {2U, 5U}) {
        const Sampled more = sampled(cloud, samples, threads);
        EXPECT_TRUE(test::same_graph(more.graph.graph, one.graph.graph));
        EXPECT_EQ(more.graph.contact, one.graph.contact);
    }
}

TEST(SampleGraph, OfAllPointsIsTheirs) {
    const Cloud cloud = test::cloud_of(test::random_positions(300, 2));
    const SampleGraph graph = sample_graph_of_all(cloud.graph);
    EXPECT_TRUE(test::same_graph(graph.graph, cloud.graph));
    expect_contacts(graph);
}

} // namespace
} // namespace knead

// Samples with one link: they go along, and nobody notices them.

#include "deform/sample_rest.h"

namespace knead {
namespace {

using test::degrees;
using test::posed;

constexpr std::size_t bar_points = 800;

// A bar held at both ends, and a point so far off its side, which hangs on the one nearest to it there.
SampleRest bar_with_leaf(double away) {
    SampleRest bar = test::bar(bar_points);
    Index host = 0;
    const Vec3d side(0.5, 0, 0);
    for (Index v = 0; v < bar.position.size(); ++v)
        if ((bar.position[v] - side).norm() < (bar.position[host] - side).norm()) host = v;
    const auto leaf = static_cast<Index>(bar.position.size());
    bar.position.push_back(bar.position[host] + Vec3d(away, 0, 0));
    bar.handle.push_back(no_index);
    Graph with;
    std::vector<double> weight;
    with.first.push_back(0);
    for (Index v = 0; v < leaf; ++v) {
        for (Index link = bar.graph.first[v]; link < bar.graph.first[v + 1]; ++link) {
            with.neighbor.push_back(bar.graph.neighbor[link]);
            weight.push_back(bar.weight[link]);
        }
        if (v == host) with.neighbor.push_back(leaf), weight.push_back(1);
        with.first.push_back(static_cast<Index>(with.neighbor.size()));
    }
    with.neighbor.push_back(host);
    weight.push_back(1);
    with.first.push_back(static_cast<Index>(with.neighbor.size()));
    bar.graph = with;
    bar.weight = weight;
    return bar;
}

SampleState bent(SampleSystem& system, int iterations) {
    Workers workers(2);
    SampleState state = rest_state(system);
    const std::vector<HandleMotion> handles{
        {}, test::motion_about(Vec3d::UnitY(), 70 * degrees, {0, 0, 2.5}, {1.5, 0, -1})};
    follow_handles(system, handles, state, workers);
    for (int i = 0; i < iterations; ++i) iterate(system, handles, state, workers);
    return state;
}

TEST(Leaves, TurnAsTheOtherEndDoesAndKeepTheirPlaceBesideIt) {
    SampleSystem system;
    ASSERT_TRUE(test::built(bar_with_leaf(2), system).solved);
    const Index leaf = bar_points;
    ASSERT_TRUE(is_leaf(system.rest, leaf));
    const Index host = system.rest.graph.row(leaf).front();
    EXPECT_FALSE(is_leaf(system.rest, host));
    const SampleState state = bent(system, 60);
    EXPECT_LT(state.rotation[leaf].angularDistance(state.rotation[host]), 1e-9);
    EXPECT_GT(state.rotation[leaf].angularDistance(Quatd::Identity()), 5 * degrees);
    const Vec3d edge = system.rest.position[leaf] - system.rest.position[host];
    const Vec3d now = posed(system, state, leaf) - posed(system, state, host);
    EXPECT_LT((now - state.rotation[host] * edge).norm(), 1e-9 * edge.norm());
}

TEST(Leaves, AreNotNoticedHoweverFarTheyAre) {
    for (const double poisson : {0.0, 0.4})
        for (const int iterations : {3, 60}) {
            SampleRest alone = test::bar(bar_points);
            alone.poisson = poisson;
            SampleSystem clean;
            ASSERT_TRUE(test::built(alone, clean).solved);
            const SampleState expected = bent(clean, iterations);
            for (const double away : {0.3, 3.0, 300.0}) {
                SampleRest rest = bar_with_leaf(away);
                rest.poisson = poisson;
                SampleSystem system;
                ASSERT_TRUE(test::built(rest, system).solved);
                const SampleState state = bent(system, iterations);
                for (std::size_t s = 0; s < bar_points; ++s)
                    ASSERT_LT((state.displacement[s] - expected.displacement[s]).norm(), 2e-3)
                        << away << " away, " << iterations << " iterations, Poisson's ratio " << poisson;
            }
        }
}

TEST(Leaves, OfAStarThatIsHeldByItsCentreGoAlong) {
    SampleRest star;
    star.position = {{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 5}};
    star.handle = {0, no_index, no_index, no_index};
    star.graph.first = {0, 3, 4, 5, 6};
    star.graph.neighbor = {1, 2, 3, 0, 0, 0};
    star.weight.assign(6, 1);
    SampleSystem system;
    ASSERT_TRUE(test::built(star, system).solved);
    const HandleMotion motion = test::motion_about({1, 2, 3}, 2, {0, 0, 0}, {1, 1, 1});
    Workers workers(1);
    SampleState state = rest_state(system);
    follow_handles(system, std::vector{motion}, state, workers);
    for (int i = 0; i < 3; ++i) iterate(system, std::vector{motion}, state, workers);
    for (std::size_t s = 0; s < 4; ++s) {
        const Vec3d expected = motion.linear * star.position[s] + motion.offset;
        EXPECT_LT((posed(system, state, s) - expected).norm(), 1e-9);
    }
}

} // namespace
} // namespace knead

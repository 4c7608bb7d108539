#include "deform/coarse_level.h"

#include "deform/bent_bar.h"
#include "graph/neighbors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <memory>
#include <set>

namespace knead {
namespace {

struct Bar : test::BentBar {
    CoarseLevel coarse;

    explicit Bar(SampleRest rest = test::bar(1200), unsigned threads = 2)
        : BentBar(std::move(rest), threads) {
        coarse.samples = coarse_samples(system.rest.graph, system.rest.position, system.rest.handle, workers);
        EXPECT_TRUE(build_coarse_level(system, coarse, workers).solved);
    }

    SampleState helped(int iterations) {
        SampleState state = started();
        Acceleration memory;
        for (int i = 0; i < iterations; ++i) iterate(system, coarse, handles, state, memory, workers);
        return state;
    }
};

TEST(CoarseLevel, IsOfFewSamplesThatTheHandlesHoldAsTheyHoldTheOthers) {
    const Bar bar;
    EXPECT_LT(bar.coarse.samples.sample.size(), bar.system.rest.handle.size() / 2);
    std::vector<bool> held(bar.handles.size(), false);
    for (std::size_t c = 0; c < bar.coarse.samples.sample.size(); ++c) {
        const Index handle = bar.system.rest.handle[bar.coarse.samples.sample[c]];
        EXPECT_EQ(bar.coarse.system.rest.handle[c], handle);
        EXPECT_EQ(bar.coarse.system.rest.position[c], bar.system.rest.position[bar.coarse.samples.sample[c]]);
        if (handle != no_index) held[handle] = true;
    }
    EXPECT_EQ(held, std::vector<bool>(bar.handles.size(), true));
    for (std::size_t s = 0; s < bar.system.rest.handle.size(); ++s) {
        float sum = 0;
        for (const float weight : bar.coarse.samples.followed[s].weight) sum += weight;
        EXPECT_NEAR(sum, 1, 1e-6); // rounding
    }
}

// A bar and a dozen rows of points beside it, each a part of its own, which both handles hold the ends of.
SampleRest bar_and_rows() {
    std::vector<float> positions = test::shape_positions(Shape::bar, 1200);
    for (int row = 0; row < 12; ++row)
        for (int k = 0; k <= 50; ++k) {
            const float place[] = {5 + 3 * static_cast<float>(row), 0, -2.5F + 0.1F * static_cast<float>(k)};
            positions.insert(positions.end(), std::begin(place), std::end(place));
        }
    return test::rest_of(test::cloud_of(std::move(positions)), test::both_ends(-2, 2));
}

TEST(CoarseLevel, HoldsEveryPartThatAHandleReachesInto) {
    SampleRest rest = bar_and_rows();
    for (Index s = 0; s < rest.handle.size(); ++s) // as with a falloff
        if (rest.handle[s] == no_index && rest.position[s].z() > 1.5)
            rest.pulled.push_back({s, 1, 0.5, rest.position[s]});
    const Bar bar(std::move(rest));
    for (std::size_t c = 0; c < bar.coarse.samples.sample.size(); ++c)
        EXPECT_FALSE(bar.coarse.system.left_out[c]) << c;
    const Components parts = find_components(bar.coarse.system.rest.graph, *std::make_unique<Workers>(1));
    std::set<std::pair<Index, Index>> held;
    for (std::size_t c = 0; c < bar.coarse.samples.sample.size(); ++c)
        if (const Index handle = bar.coarse.system.rest.handle[c]; handle != no_index)
            held.insert({handle, parts.component[c]});
    EXPECT_EQ(held.size(), 2U * 13U);
}

// One that were carried by itself alone would go otherwise than those right beside it.
TEST(CoarseLevel, BlendsCoarseSamplesLikeTheOthers) {
    const Bar bar;
    std::size_t free = 0;
    for (const Index s : bar.coarse.samples.sample) {
        if (bar.system.rest.handle[s] != no_index) continue;
        ++free;
        EXPECT_LT(std::ranges::max(bar.coarse.samples.followed[s].weight), 0.99F) << s;
    }
    EXPECT_GT(free, 10U);
}

TEST(CoarseLevel, ComesToTheSameShapeInFewerIterations) {
    Bar bar;
    const SampleState settled = bar.after_accelerated(300);
    EXPECT_LT(bar.between(bar.helped(30), settled), 1e-6);
    for (const int iterations : {1, 2, 3, 5})
        EXPECT_LT(bar.between(bar.helped(iterations), settled),
                  0.4 * bar.between(bar.after_accelerated(iterations), settled))
            << iterations;
}

TEST(CoarseLevel, LeavesASettledShapeAsItIs) {
    Bar bar;
    SampleState state = bar.after_accelerated(300);
    const SampleState settled = state;
    Acceleration memory;
    for (int i = 0; i < 5; ++i) iterate(bar.system, bar.coarse, bar.handles, state, memory, bar.workers);
    EXPECT_LT(bar.between(state, settled), 1e-9); // what was left
}

TEST(CoarseLevel, LeavesRestAtRest) {
    Bar bar;
    bar.handles = {{}, {}};
    const SampleState state = bar.helped(5);
    for (const Vec3d& way : state.displacement) ASSERT_EQ(way, Vec3d::Zero());
    for (const Quatd& rotation : state.rotation) ASSERT_EQ(rotation.coeffs(), Quatd::Identity().coeffs());
}

TEST(CoarseLevel, IsGivenUpWhereItDoesNotHelp) {
    // A coarse level that pushes all samples aside: each iteration goes as far as the one before.
    Bar bar;
    const SampleState settled = bar.after_accelerated(300);
    for (double& weight : bar.coarse.system.rest.weight) weight *= 40; // no longer what was factorised
    for (Vec3d& edge : bar.coarse.system.weighted_edge) edge *= 40;
    SampleState state = bar.started();
    Acceleration memory;
    for (int i = 0; i < 120; ++i) iterate(bar.system, bar.coarse, bar.handles, state, memory, bar.workers);
    EXPECT_TRUE(memory.alone);
    EXPECT_LT(bar.between(state, settled), 1e-6);
    forget(memory);
    EXPECT_FALSE(memory.alone);
}

TEST(CoarseLevel, GivesTheSameBitsAgainAndForAnyNumberOfThreads) {
    std::vector<SampleState> results;
    for (const unsigned threads : {1U, 2U, 3U, 2U}) {
        results.push_back(Bar(test::bar(1200), threads).helped(4));
    }
    for (const SampleState& result : results)
        for (std::size_t s = 0; s < result.displacement.size(); ++s)
            ASSERT_EQ(std::memcmp(result.displacement[s].data(), results[0].displacement[s].data(),
                                  3 * sizeof(double)),
                      0);
}

// --- Frames for which the coarse samples answer ---

// The bar's way to its handles' motions in ten frames, coarse ones or of all samples.
struct Dragged : Bar {
    using Bar::Bar;
    CoarseFollowing following;

    std::vector<HandleMotion> on_the_way(double part) const {
        return {{},
                test::motion_about(Vec3d(1, 0, 0), part * 100 * test::degrees, Vec3d(0, 0, 0),
                                   part * Vec3d(0.3, -1, 0.2))};
    }
    SampleState coarsely(unsigned threads = 2) {
        Workers some(threads);
        SampleState state = rest_state(system);
        following = {};
        anchor(system, coarse, on_the_way(0), state, following, some);
        for (int frame = 1; frame <= 10; ++frame)
            follow_coarsely(system, coarse, on_the_way(frame / 10.0), 3, following, state, some);
        return state;
    }
    SampleState finely() {
        SampleState state = rest_state(system);
        for (int frame = 1; frame <= 10; ++frame) {
            const std::vector<HandleMotion> motions = on_the_way(frame / 10.0);
            follow_handles(system, motions, state, workers);
            Acceleration memory;
            for (int i = 0; i < 3; ++i) iterate(system, coarse, motions, state, memory, workers);
        }
        return state;
    }
};

TEST(CoarseFollowing, IsNearlyWhereAllSamplesWouldBe) {
    Dragged bar;
    const SampleState coarse = bar.coarsely();
    EXPECT_LT(bar.between(coarse, bar.finely()), 0.01);
    for (std::size_t s = 0; s < coarse.rotation.size(); ++s)
        ASSERT_NEAR(coarse.rotation[s].norm(), 1, 1e-9) << s;
}

TEST(CoarseFollowing, EndsWhereAllSamplesEnd) {
    Dragged bar;
    SampleState coarse = bar.coarsely(), fine = bar.finely();
    Acceleration of_coarse, of_fine;
    for (int i = 0; i < 40; ++i) {
        iterate(bar.system, bar.coarse, bar.handles, coarse, of_coarse, bar.workers);
        iterate(bar.system, bar.coarse, bar.handles, fine, of_fine, bar.workers);
    }
    EXPECT_LT(bar.between(coarse, fine), 1e-6);
}

TEST(CoarseFollowing, LeavesASettledShapeAsItIs) {
    // Where the coarse samples by themselves would make another of it.
    Dragged bar;
    SampleState state = bar.after_accelerated(300);
    const SampleState settled = state;
    anchor(bar.system, bar.coarse, bar.handles, state, bar.following, bar.workers);
    for (int frame = 0; frame < 5; ++frame)
        follow_coarsely(bar.system, bar.coarse, bar.handles, 3, bar.following, state, bar.workers);
    EXPECT_LT(bar.between(state, settled), 1e-8);
}

TEST(CoarseFollowing, StandsUpFromAShapeThatIsFlat) {
    Dragged bar;
    HandleMotion pressed;
    pressed.linear = Vec3d(1, 1, 0).asDiagonal();
    SampleState state = rest_state(bar.system);
    for (std::size_t s = 0; s < state.displacement.size(); ++s)
        state.displacement[s].z() = -bar.system.rest.position[s].z();
    anchor(bar.system, bar.coarse, std::vector{pressed, pressed}, state, bar.following, bar.workers);
    follow_coarsely(bar.system, bar.coarse, bar.on_the_way(0), 3, bar.following, state, bar.workers);
    for (std::size_t s = 0; s < state.displacement.size(); ++s)
        ASSERT_LT(test::posed(bar.system, state, s).norm(), 2 * bar.system.rest.cloud_size);
}

TEST(CoarseFollowing, MovesASettledShapeWithItsHandlesAsAWhole) {
    Dragged bar;
    SampleState state = bar.after_accelerated(300);
    const SampleState settled = state;
    anchor(bar.system, bar.coarse, bar.handles, state, bar.following, bar.workers);
    Quatd turn = Quatd::Identity();
    for (int frame = 1; frame <= 40; ++frame) { // 400 degrees
        turn = Eigen::AngleAxisd(10 * test::degrees, Vec3d(1, 2, 3).normalized()) * turn;
        std::vector<HandleMotion> moved = bar.handles;
        for (HandleMotion& motion : moved) {
            motion.rotation = turn * motion.rotation;
            motion.linear = turn * motion.linear;
            motion.offset = turn * motion.offset;
        }
        follow_coarsely(bar.system, bar.coarse, moved, 3, bar.following, state, bar.workers);
        for (std::size_t s = 0; s < state.displacement.size(); s += 7) {
            const Vec3d expected = turn * test::posed(bar.system, settled, s);
            ASSERT_LT((test::posed(bar.system, state, s) - expected).norm(), 1e-3) << frame; // iterations
        }
    }
}

TEST(CoarseFollowing, GivesTheSameBitsForAnyNumberOfThreads) {
    Dragged bar;
    const SampleState one = bar.coarsely(1), three = bar.coarsely(3);
    for (std::size_t s = 0; s < one.displacement.size(); ++s)
        ASSERT_EQ(one.displacement[s], three.displacement[s]);
}

// A bar with a handle that gives positions only, and that pulls what is around it.
SampleRest bar_of_all_kinds() {
    SampleRest rest = test::bar(1200);
    rest.turns_freely = {false, true};
    for (Index s = 0; s < rest.handle.size(); s += 3)
        if (rest.handle[s] == no_index && rest.position[s].z() > 0.5)
            rest.pulled.push_back({s, 1, 0.5, rest.position[s]});
    return rest;
}

TEST(CoarseFollowing, KnowsAllKindsOfHandles) {
    Dragged bar(bar_of_all_kinds());
    EXPECT_LT(bar.between(bar.coarsely(), bar.finely()), 0.015);
}

TEST(CoarseLevel, CarriesAllKindsOfHandles) {
    Bar bar(bar_of_all_kinds());
    ASSERT_FALSE(bar.coarse.system.rest.pulled.empty());
    const SampleState settled = bar.after_accelerated(600);
    EXPECT_LT(bar.between(bar.helped(60), settled), 1e-5);
}

} // namespace
} // namespace knead

// Handles that leave rotation free, and handles that pull.

#include "deform/sample_rest.h"

namespace knead {
namespace {

using test::degrees;
using test::posed;

SampleState settled(SampleSystem& system, const std::vector<HandleMotion>& handles) {
    Workers workers(2);
    SampleState state = rest_state(system);
    follow_handles(system, handles, state, workers);
    for (int i = 0; i < 200; ++i) iterate(system, handles, state, workers);
    return state;
}

// The turn of a bar's upper end about y, in degrees, when it is shifted aside.
double turn_of_end(bool turns_freely) {
    SampleRest rest = test::bar(1500);
    rest.turns_freely = {false, turns_freely};
    SampleSystem system;
    EXPECT_TRUE(test::built(rest, system).solved);
    const HandleMotion aside{Quatd::Identity(), Mat3d::Identity(), Vec3d(1.5, 0, 0)};
    const SampleState state = settled(system, {{}, aside});
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t s = 0; s < rest.handle.size(); ++s) {
        if (rest.handle[s] != 1) continue;
        EXPECT_LT((posed(system, state, s) - rest.position[s] - aside.offset).norm(), 1e-12);
        sum += 2 * std::asin(state.rotation[s].y()) / degrees;
        ++count;
    }
    return sum / static_cast<double>(count);
}

TEST(FreeRotation, LetsTheSamplesOfAHandleTurnAndKeepsThemInPlace) {
    EXPECT_EQ(turn_of_end(false), 0);
    // The end's own edges do not turn, its border leans towards where the bar went.
    EXPECT_GT(turn_of_end(true), 1);
}

TEST(FreeRotation, OfAllHandlesStillHasOneAnswer) {
    SampleRest rest = test::bar(800);
    rest.turns_freely = {true, true};
    SampleSystem system;
    ASSERT_TRUE(test::built(rest, system).solved);
    const SampleState still = settled(system, {{}, {}});
    for (const Vec3d& way : still.displacement) ASSERT_EQ(way, Vec3d::Zero());
    // A rigid motion of all handles' positions turns everything.
    const HandleMotion motion =
        test::motion_about(Vec3d(1, 1, 0), 50 * degrees, Vec3d::Zero(), Vec3d(1, 2, 3));
    const SampleState state = settled(system, {motion, motion});
    for (const Index s : system.free_sample) {
        const Vec3d expected = motion.linear * rest.position[s] + motion.offset;
        ASSERT_LT((posed(system, state, s) - expected).norm(), 1e-5); // iterated, not solved
    }
}

TEST(FreeRotation, OfASampleWithoutLinksIsNoSingularSystem) {
    SampleRest rest = test::bar(800);
    const auto samples = static_cast<Index>(rest.handle.size());
    rest.graph.first.push_back(rest.graph.first.back()); // one more, alone
    rest.position.emplace_back(9, 9, 9);
    rest.handle.push_back(1);
    rest.turns_freely = {false, true};
    SampleSystem system;
    ASSERT_TRUE(test::built(rest, system).solved);
    const HandleMotion motion =
        test::motion_about(Vec3d::UnitZ(), 40 * degrees, Vec3d::Zero(), Vec3d(1, 0, 0));
    const SampleState state = settled(system, {{}, motion});
    EXPECT_LT((posed(system, state, samples) - motion.linear * Vec3d(9, 9, 9) - motion.offset).norm(), 1e-12);
}

// Equation (1) alone.
std::vector<Quatd> turns_at_start(const SampleRest& rest, const std::vector<HandleMotion>& handles) {
    SampleSystem system;
    EXPECT_TRUE(test::built(rest, system).solved);
    Workers workers(2);
    SampleState state = rest_state(system);
    follow_handles(system, handles, state, workers);
    return state.rotation;
}

TEST(Pull, TurnsWhatItPulls) {
    SampleRest rest = test::bar(1200);
    const std::vector<HandleMotion> handles{
        {}, test::motion_about(Vec3d::UnitZ(), 90 * degrees, Vec3d::Zero(), Vec3d::Zero())};
    const auto plain = turns_at_start(rest, handles);
    for (Index s = 0; s < rest.handle.size(); ++s)
        if (rest.handle[s] == no_index && rest.position[s].z() > 1)
            rest.pulled.push_back({s, 1, 1e4, rest.position[s]});
    const auto pulled = turns_at_start(rest, handles);
    for (std::size_t s = 0; s < plain.size(); ++s) {
        const double left = pulled[s].angularDistance(handles[1].rotation);
        ASSERT_LE(left, plain[s].angularDistance(handles[1].rotation) + 1e-9);
        if (rest.position[s].z() > 1) {
            ASSERT_LT(left, 0.01);
        }
        if (rest.handle[s] == 0) {
            ASSERT_LT(pulled[s].angularDistance(Quatd::Identity()), 1e-9);
        }
    }
}

TEST(Pull, OfAHandleThatLeavesRotationFreeLetsTurnsThrough) {
    SampleRest rest = test::bar(1200);
    const std::vector<HandleMotion> handles{
        {}, test::motion_about(Vec3d::UnitZ(), 90 * degrees, Vec3d::Zero(), Vec3d::Zero()), {}};
    Index peg = no_index;
    for (Index s = 0; s < rest.handle.size() && peg == no_index; ++s)
        if (rest.handle[s] == no_index && std::abs(rest.position[s].z()) < 0.2) peg = s;
    rest.handle[peg] = 2;
    rest.turns_freely = {false, false, true};
    const auto plain = turns_at_start(rest, handles);
    for (Index s = 0; s < rest.handle.size(); ++s)
        if (rest.handle[s] == no_index && (rest.position[s] - rest.position[peg]).norm() < 0.6)
            rest.pulled.push_back({s, 2, 10, rest.position[peg], 0, peg, 0});
    ASSERT_FALSE(rest.pulled.empty());
    const auto pulled = turns_at_start(rest, handles);
    for (std::size_t s = 0; s < plain.size(); ++s)
        ASSERT_LT((plain[s].coeffs() - pulled[s].coeffs()).norm(), 1e-5); // a billionth on the diagonal
}

TEST(Pull, IsACompromiseThatTakesNoSide) {
    SampleRest rest = test::bar(800);
    Index middle = 0;
    for (Index s = 0; s < rest.handle.size(); ++s)
        if (rest.position[s].norm() < rest.position[middle].norm()) middle = s;
    ASSERT_EQ(rest.handle[middle], no_index);
    const Vec3d place = rest.position[middle];
    rest.pulled = {{middle, 0, 1e6, place}, {middle, 1, 1e6, place}};
    SampleSystem system;
    ASSERT_TRUE(test::built(rest, system).solved);
    const SampleState state = settled(system, {{}, {Quatd::Identity(), Mat3d::Identity(), Vec3d(0.6, 0, 0)}});
    // Half-way between what both want; the links around weigh a millionth.
    EXPECT_LT((state.displacement[middle] - Vec3d(0.3, 0, 0)).norm(), 1e-5);
}

TEST(Pull, LeavesRestAtRest) {
    SampleRest rest = test::bar(800);
    for (Index s = 0; s < rest.handle.size(); s += 7)
        if (rest.handle[s] == no_index) rest.pulled.push_back({s, 1, 0.5, rest.position[s]});
    SampleSystem system;
    ASSERT_TRUE(test::built(rest, system).solved);
    for (const Vec3d& way : settled(system, {{}, {}}).displacement) ASSERT_EQ(way, Vec3d::Zero());
}

} // namespace
} // namespace knead

// Whole turns are kept: the quaternions of the handles and the warm start carry them from frame to frame.

#include "deform/sample_rest.h"

#include <complex>

namespace knead {
namespace {

using test::degrees;

// Turns handle 1 by 10° a frame about z, three iterations a frame.
SampleState twisted(SampleSystem& system, int frames) {
    Workers workers(2);
    SampleState state = rest_state(system);
    std::vector<HandleMotion> handles(2);
    for (int frame = 1; frame <= frames; ++frame) {
        handles[1] = test::motion_about(Vec3d::UnitZ(), 10 * frame * degrees, Vec3d::Zero(), Vec3d::Zero());
        follow_handles(system, handles, state, workers);
        for (int i = 0; i < 3; ++i) iterate(system, handles, state, workers);
    }
    return state;
}

// The twist from the lowest of `slices` equal slices along z to the highest, in degrees: mean angles about
// the axis, summed up over steps of less than half a turn.
double total_twist(const SampleSystem& system, const SampleState& state, double low, double high,
                   int slices) {
    std::vector<std::complex<double>> turn(static_cast<std::size_t>(slices), 0);
    for (std::size_t s = 0; s < state.rotation.size(); ++s) {
        const Vec3d& p = system.rest.position[s];
        const Vec3d x = test::posed(system, state, s);
        const int slice = std::clamp(static_cast<int>((p.z() - low) / (high - low) * slices), 0, slices - 1);
        turn[static_cast<std::size_t>(slice)] +=
            std::complex(x.x(), x.y()) * std::conj(std::complex(p.x(), p.y()));
    }
    double sum = 0;
    for (std::size_t slice = 1; slice < turn.size(); ++slice)
        sum += std::arg(turn[slice] * std::conj(turn[slice - 1]));
    return sum / degrees;
}

// The slices at both ends are held, so the sum is the handle's angle exactly if no turn was lost, and a
// whole turn off if one was.
void expect_all_turns(SampleRest rest, double low, double high, int frames = 72) {
    SampleSystem system;
    ASSERT_TRUE(test::built(std::move(rest), system).solved);
    const SampleState state = twisted(system, frames);
    EXPECT_NEAR(total_twist(system, state, low, high, 40), 10 * frames, 1);
    // And they are spread along the whole of it: the middle is half-way.
    double middle = 0;
    int count = 0;
    for (const Index s : system.free_sample) {
        if (std::abs(system.rest.position[s].z() - 0.5 * (low + high)) > 0.02 * (high - low)) continue;
        const Quatd& r = state.rotation[s];
        const double angle = 2 * std::atan2(r.z(), r.w()) / degrees; // of 0 … 720 once it is positive
        middle += angle < 0 ? angle + 720 : angle;
        ++count;
    }
    ASSERT_GT(count, 5);
    EXPECT_NEAR(middle / count, 5 * frames, 30);
}

TEST(Twist, OfATubeKeepsTwoTurns) {
    const test::Cloud tube = test::cloud_of(test::tube_positions(61, 20, 0.5, 10));
    expect_all_turns(test::rest_of(tube, test::both_ends(0.8, 9.2)), 0, 10);
}

TEST(Twist, OfALongBarKeepsTwoTurns) {
    std::vector<float> positions = test::shape_positions(Shape::bar, 3000);
    for (std::size_t i = 0; i < positions.size(); i += 3) { // 1 × 1 × 10 from 1 × 1 × 5
        positions[i] *= 0.5F;
        positions[i + 1] *= 0.5F;
    }
    expect_all_turns(test::rest_of(test::cloud_of(positions), test::both_ends(-2.2, 2.2)), -2.5, 2.5);
}

TEST(Twist, OfAShortSolidBarKeepsTwoTurns) {
    const test::Cloud solid = test::cloud_of(test::shape_positions(Shape::solid_bar, 4000));
    expect_all_turns(test::rest_of(solid, test::both_ends(-2.2, 2.2)), -2.5, 2.5);
}

TEST(Twist, OfAShortTubeKeepsATurnAndAHalf) {
    // 1 : 5. Where it is hollow it narrows to the axis in the middle, and from 650° on slips through itself.
    const test::Cloud cylinder = test::cloud_of(test::shape_positions(Shape::cylinder, 3000));
    expect_all_turns(test::rest_of(cylinder, test::both_ends(-2.2, 2.2)), -2.5, 2.5, 54);
}

TEST(Twist, CanBeTurnedBack) {
    // 720° and back again, with a pause: what is left is what the iterations have not yet undone.
    SampleSystem system;
    ASSERT_TRUE(test::built(test::rest_of(test::cloud_of(test::tube_positions(41, 16, 0.5, 8)),
                                          test::both_ends(0.8, 7.2)),
                            system)
                    .solved);
    Workers workers(2);
    SampleState state = twisted(system, 72);
    std::vector<HandleMotion> handles(2);
    for (int frame = 71; frame >= 0; --frame) {
        handles[1] = test::motion_about(Vec3d::UnitZ(), 10 * frame * degrees, Vec3d::Zero(), Vec3d::Zero());
        follow_handles(system, handles, state, workers);
        for (int i = 0; i < 3; ++i) iterate(system, handles, state, workers);
    }
    for (int i = 0; i < 300; ++i) iterate(system, handles, state, workers);
    for (const Vec3d& displacement : state.displacement)
        ASSERT_LT(displacement.norm(), 1e-3 * system.rest.cloud_size);
}

TEST(Twist, OfAHandleThatJumpsTakesItsSignAsGiven) {
    // One place, two ways there: 200° about z, or 160° against it.
    const test::Cloud tube = test::cloud_of(test::tube_positions(61, 20, 0.5, 10));
    SampleSystem system;
    ASSERT_TRUE(test::built(test::rest_of(tube, test::both_ends(0.8, 9.2)), system).solved);
    std::vector<HandleMotion> handles(2);
    handles[1] = test::motion_about(Vec3d::UnitZ(), 200 * degrees, Vec3d::Zero(), Vec3d::Zero());
    Workers workers(2);
    SampleState state = rest_state(system);
    follow_handles(system, handles, state, workers);
    EXPECT_NEAR(total_twist(system, state, 0, 10, 40), 200, 1);
    handles[1].rotation.coeffs() *= -1;
    state = rest_state(system);
    follow_handles(system, handles, state, workers);
    EXPECT_NEAR(total_twist(system, state, 0, 10, 40), -160, 1);
}

} // namespace
} // namespace knead

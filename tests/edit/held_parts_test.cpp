// How much of links between samples lies on handles.

#include "edit/held_parts.h"
#include "graph/clouds.h"

namespace knead {
namespace {

using test::Machine;

// A strip, one apart; what is left of 50.5 is held. A free sample at 56 is linked to two held ones, at 45 and
// at 50, and to a free one.
TEST(HeldParts, AreTheWaysToTheBorder) {
    Machine machine;
    const test::Cloud cloud = test::cloud_of(test::grid_positions(101, 21));
    std::vector<Index> label, samples(4);
    std::vector<FloodStart> border;
    constexpr Index handle_number = 4; // after those of the samples
    const auto place = [&](Index v) { return cloud.at(v); };
    for (Index v = 0; v < cloud.size(); ++v) {
        label.push_back(place(v).x() < 50.5 ? 0 : no_index);
        if (place(v).x() == 50) border.push_back({v, handle_number});
        for (const auto& [s, x] : {std::pair{0, 45}, {1, 50}, {2, 56}, {3, 60}})
            if (place(v) == Vec3d(x, 10, 0)) samples[static_cast<std::size_t>(s)] = v;
    }
    InfluenceRows nearest = flood(cloud.graph, cloud.lengths, samples, machine.workers, machine.progress);
    nearest.first_handle = handle_number;
    add_starts(nearest, cloud.graph, cloud.lengths, border, machine.workers, machine.progress);
    Graph between;
    between.first = {0, 1, 2, 5, 6};
    between.neighbor = {2, 2, 0, 1, 3, 2};
    const auto parts = [&](const InfluenceRows& rows) {
        return held_parts({between, samples, label, cloud.graph, cloud.lengths, cloud.positions, rows},
                          machine.workers);
    };
    const std::vector<float> found = parts(nearest);
    EXPECT_NEAR(found[2], 5.5 / 11, 0.05);
    EXPECT_NEAR(found[3], 0.5 / 6, 0.05);
    for (const std::size_t other : {0U, 1U, 4U, 5U}) EXPECT_EQ(found[other], 0) << other;
    nearest.first_handle = 5; // no row tells of it
    EXPECT_NEAR(parts(nearest)[3], 0.5 + 0.5 / 6, 0.05);
    EXPECT_EQ(parts({})[3], 0.5F); // every point a sample
}

} // namespace
} // namespace knead

#include "graph/clouds.h"
#include "graph/sampling.h"

#include <map>
#include <numeric>
#include <set>

namespace knead {
namespace {

using test::all_different;
using test::Cloud;
using test::Machine;
using test::octree_of;

std::vector<Index> handle_samples_of(const Cloud& cloud, std::span<const Index> label,
                                     std::span<const Index> base, std::size_t budget,
                                     std::span<const std::uint8_t> hanging = {},
                                     const std::vector<bool>& everywhere = {}) {
    Machine machine;
    const InfluenceRows nearest = flood(cloud.graph, cloud.lengths, base, machine.workers, machine.progress);
    const std::vector<std::uint8_t> held(blocks_of_rows(label.size()), 1);
    std::vector<HeldBlock> blocks;
    find_held({label, held}, held, cloud.graph, cloud.positions, cloud.components, machine.workers, blocks);
    VertexShape shape = cloud.shape();
    shape.hanging = hanging;
    return handle_samples(shape, {label, held}, blocks, base,
                          territories_of_base(nearest, base.size(), cloud.graph, machine.workers), everywhere,
                          budget)
        .added;
}

using Part = std::pair<Index, Index>; // handle, component

std::set<Part> parts_of(const Cloud& cloud, const std::vector<Index>& label,
                        const std::vector<Index>& vertices) {
    std::set<Part> parts;
    for (const Index v : vertices)
        if (label[v] != no_index) parts.insert({label[v], cloud.components.component[v]});
    return parts;
}

std::vector<Index> everything(const Cloud& cloud) {
    std::vector<Index> all(cloud.size());
    std::iota(all.begin(), all.end(), Index{0});
    return all;
}

// All of `base` and `added` together, which must be different vertices.
std::vector<Index> joined(std::vector<Index> base, const std::vector<Index>& added) {
    base.insert(base.end(), added.begin(), added.end());
    EXPECT_TRUE(all_different(base)) << "a vertex was added twice, or is a base sample already";
    return base;
}

// Handle 0: the low end; 1: the high end; 2: a single vertex in the middle.
std::vector<Index> label_tube(const Cloud& cloud) {
    std::vector<Index> label(cloud.size(), no_index);
    Index middle = 0;
    for (Index v = 0; v < cloud.size(); ++v) {
        const double z = cloud.at(v).z();
        if (z < -2) label[v] = 0;
        if (z > 2.2) label[v] = 1;
        if ((cloud.at(v) - Vec3d(0.5, 0, 0)).norm() < (cloud.at(middle) - Vec3d(0.5, 0, 0)).norm())
            middle = v;
    }
    label[middle] = 2;
    return label;
}

TEST(HandleSamples, GiveEveryHandleOneHoweverThin) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::cylinder, 6000));
    const std::vector<Index> label = label_tube(cloud);
    for (const std::size_t budget : {0U, 1U, 2U, 30U, 100000U}) {
        for (const std::size_t base_count : {0U, 1U, 20U}) {
            const std::vector<Index> base = octree_of(cloud, base_count);
            const auto samples = joined(base, handle_samples_of(cloud, label, base, budget));
            EXPECT_EQ(parts_of(cloud, label, samples), parts_of(cloud, label, everything(cloud)))
                << "budget " << budget << ", base " << base_count;
        }
    }
}

// An outlier belongs to the handle that it hangs on; the middle of both is as near to either.
TEST(HandleSamples, AreNoOutliersWhereThereIsAnotherVertex) {
    const Cloud cloud = test::cloud_of(test::grid_positions(20, 20));
    for (Index outlier = 0; outlier < cloud.size(); outlier += 37) {
        std::vector<Index> label(cloud.size(), no_index);
        std::vector<std::uint8_t> hanging(cloud.size(), 0);
        const Index host = cloud.graph.row(outlier).front();
        label[outlier] = label[host] = 0;
        hanging[outlier] = 1;
        EXPECT_EQ(handle_samples_of(cloud, label, {}, 0, hanging), std::vector<Index>{host});
        label[host] = no_index;
        EXPECT_EQ(handle_samples_of(cloud, label, {}, 0, hanging), std::vector<Index>{outlier});
    }
}

// A piece that is held as a whole moves nothing that is free.
TEST(HandleSamples, AreNoneInAComponentWithoutABorder) {
    const Cloud cloud = test::cloud_of(test::two_patches(false));
    std::vector<Index> label(cloud.size(), no_index);
    for (Index v = 0; v < cloud.size(); ++v) {
        const bool in_first = cloud.components.component[v] == cloud.components.component[0];
        if (!in_first || cloud.at(v).y() < 4) label[v] = 0;
    }
    const auto added = handle_samples_of(cloud, label, {}, 0);
    EXPECT_EQ(parts_of(cloud, label, added), (std::set<Part>{{0, cloud.components.component[0]}}));
    EXPECT_EQ(handle_samples_of(cloud, label, {}, 0, {}, {true}).size(), 2U) << "where it is asked to";
}

TEST(HandleSamples, GiveAHandleOneInEveryComponentThatItReachesInto) {
    const Cloud cloud = test::cloud_of(test::two_patches(false));
    std::vector<Index> label(cloud.size(), no_index);
    for (Index v = 0; v < cloud.size(); ++v)
        if (cloud.at(v).y() < 4) label[v] = cloud.at(v).x() < 6 ? 1 : 0; // the first patch ends at x = 11
    label[0] = 0;
    label[cloud.size() - 1] = 0;
    const std::set<Part> all = parts_of(cloud, label, everything(cloud));
    EXPECT_GE(all.size(), 3U) << "the handles are meant to reach into both components";
    const auto added = handle_samples_of(cloud, label, {}, 0);
    EXPECT_EQ(added.size(), all.size());
    EXPECT_EQ(parts_of(cloud, label, added), all);
}

bool touches_free(const Cloud& cloud, const std::vector<Index>& label, Index v) {
    return std::ranges::any_of(cloud.graph.row(v), [&](Index u) { return label[u] == no_index; });
}

// How many of them each handle has. All lie on its border.
std::map<Index, std::size_t> count_by_handle(const Cloud& cloud, const std::vector<Index>& label,
                                             const std::vector<Index>& added) {
    std::map<Index, std::size_t> count;
    for (const Index v : added) {
        EXPECT_NE(label[v], no_index);
        EXPECT_TRUE(touches_free(cloud, label, v)) << "not on the border";
        ++count[label[v]];
    }
    return count;
}

TEST(HandleSamples, SpreadTheBudgetAlongTheBorders) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::cylinder, 6000));
    const std::vector<Index> label = label_tube(cloud);
    const std::vector<Index> base = octree_of(cloud, 200);
    const auto added = handle_samples_of(cloud, label, base, 30);
    joined(base, added);
    EXPECT_EQ(added.size(), 30U) << "the two rims alone would take more";
    auto count = count_by_handle(cloud, label, added);
    EXPECT_NEAR(static_cast<double>(count[0]), static_cast<double>(count[1]), 3) << "the rims are alike";
    EXPECT_EQ(count[2], 1U) << "it has one vertex, and is not left out for that";
    ASSERT_GT(count[0], 0U);
    // Around the rim: no gap of more than a quarter turn between a dozen samples.
    std::vector<double> angles;
    for (const Index v : added)
        if (label[v] == 0) angles.push_back(std::atan2(cloud.at(v).y(), cloud.at(v).x()));
    std::ranges::sort(angles);
    angles.push_back(angles.front() + 2 * std::numbers::pi);
    for (std::size_t i = 1; i < angles.size(); ++i)
        EXPECT_LT(angles[i] - angles[i - 1], std::numbers::pi / 2);
}

TEST(HandleSamples, AreTwoATerritory) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::cylinder, 6000));
    std::vector<Index> label = label_tube(cloud);
    std::ranges::replace(label, Index{2}, no_index);
    const std::vector<Index> base = octree_of(cloud, 100);
    Machine machine;
    const std::vector<Index> territory =
        territories(cloud.graph, cloud.lengths, base, machine.workers, machine.progress);
    std::map<Index, std::set<Index>> crossed; // by handle
    for (Index v = 0; v < cloud.size(); ++v)
        if (label[v] != no_index && std::ranges::find(base, v) == base.end() && touches_free(cloud, label, v))
            crossed[label[v]].insert(territory[v]);
    auto count = count_by_handle(cloud, label, handle_samples_of(cloud, label, base, 100000));
    for (const Index handle : {0U, 1U}) EXPECT_EQ(count[handle], 2 * crossed[handle].size());
}

TEST(HandleSamples, GoWhereTheBorderIsLonger) {
    const Cloud cloud = test::cloud_of(test::grid_positions(60, 40));
    std::vector<Index> label(cloud.size(), no_index);
    for (Index v = 0; v < cloud.size(); ++v) {
        if (cloud.at(v).y() < 3) label[v] = 0;                          // a border of 60
        if (cloud.at(v).y() > 36 && cloud.at(v).x() < 15) label[v] = 1; // a border of some 15
    }
    const auto added = handle_samples_of(cloud, label, octree_of(cloud, 100), 20);
    auto count = count_by_handle(cloud, label, added);
    EXPECT_EQ(count[0] + count[1], 20U);
    EXPECT_GE(count[0], 2 * count[1]);
    EXPECT_GE(count[1], 3U);
}

TEST(HandleSamples, LeaveNoBorderOut) {
    const Cloud cloud = test::cloud_of(test::grid_positions(80, 40));
    std::vector<Index> label(cloud.size(), no_index);
    for (Index v = 0; v < cloud.size(); ++v) {
        const Vec3d p = cloud.at(v);
        if (p.y() < 3) label[v] = 0; // a long border, and four short ones
        for (Index patch = 0; patch < 4; ++patch)
            if (std::abs(p.x() - 20 * patch - 8) <= 2 && std::abs(p.y() - 30) <= 2) label[v] = 1 + patch;
    }
    const std::vector<Index> base = octree_of(cloud, 300); // some in every handle
    for (const std::size_t budget : {5U, 6U, 12U}) {
        const auto added = handle_samples_of(cloud, label, base, budget);
        EXPECT_EQ(added.size(), budget);
        EXPECT_EQ(count_by_handle(cloud, label, added).size(), 5U) << "budget " << budget;
    }
}

TEST(HandleSamples, StayWithinTheBudgetWhereBaseSamplesHoldEveryHandle) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::cylinder, 6000));
    std::vector<Index> label = label_tube(cloud);
    std::ranges::replace(label, Index{2}, no_index);
    const std::vector<Index> base = octree_of(cloud, 200);
    for (const std::size_t budget : {0U, 1U, 7U, 40U})
        EXPECT_LE(handle_samples_of(cloud, label, base, budget).size(), budget);
}

TEST(HandleSamples, AreNoneWithoutHandlesOrWhereEveryPointIsASample) {
    const Cloud cloud = test::cloud_of(test::shape_positions(Shape::cylinder, 1000));
    const std::vector<Index> free(cloud.size(), no_index);
    EXPECT_TRUE(handle_samples_of(cloud, free, {}, 100).empty());
    EXPECT_TRUE(handle_samples_of(cloud, label_tube(cloud), everything(cloud), 100).empty());
}

TEST(HandleSamples, AreFoundWhereAHandleHoldsAWholeComponent) {
    const Cloud cloud = test::cloud_of(test::two_patches(false)); // it has no border then
    const std::vector<Index> label = cloud.components.component.of_all();
    EXPECT_EQ(handle_samples_of(cloud, label, {}, 50).size(), 2U);
}

} // namespace
} // namespace knead

// Which parts of handles are small, what is around them, and the samples that it gets.

#include "edit/bed_samples.h"
#include "graph/clouds.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace knead {
namespace {

using test::all_different;
using test::Cloud;
using test::Machine;

constexpr double size = 100; // of the cloud, as the patches are told it

// A hundred by a hundred, one apart, and handle 0 on it.
struct Sheet {
    explicit Sheet(const std::function<bool(const Vec3d&)>& is_held) {
        for (std::size_t v = 0; v < cloud.size(); ++v) label.push_back(is_held(cloud.at(v)) ? 0 : no_index);
        const std::vector<std::uint8_t> held(blocks_of_rows(label.size()), 1);
        find_held({label, held}, held, cloud.graph, cloud.positions, cloud.components, machine.workers,
                  blocks);
    }

    std::vector<SmallPatch> patches() const {
        return small_patches(1, label, blocks, cloud.graph, cloud.positions, size);
    }
    Vicinities near(const std::vector<SmallPatch>& patches, const std::vector<Index>& samples = {}) {
        return vicinities(1, patches, samples, label, blocks, cloud.graph, cloud.positions, machine.workers,
                          machine.progress);
    }

    Machine machine;
    Cloud cloud = test::cloud_of(test::grid_positions(101, 101));
    std::vector<Index> label;
    std::vector<HeldBlock> blocks;
};

bool is_at(const Vec3d& p, double x, double y) {
    return std::hypot(p.x() - x, p.y() - y) < 0.5;
}
bool is_in_disc(const Vec3d& p) {
    return std::hypot(p.x() - 50, p.y() - 50) <= 20;
}

TEST(SmallPatches, PointsFarApartArePatchesOfTheirOwn) {
    Sheet sheet([](const Vec3d& p) { return is_at(p, 20, 20) || is_at(p, 80, 20) || is_at(p, 50, 80); });
    const std::vector<SmallPatch> patches = sheet.patches();
    ASSERT_EQ(patches.size(), 3U);
    for (const SmallPatch& patch : patches) {
        EXPECT_EQ(patch.vertices.size(), 1U);
        EXPECT_NEAR(patch.falloff, largest_small_falloff * size, 2);
    }
    const Vicinities near = sheet.near(patches);
    ASSERT_EQ(near.size(), 1U);
    EXPECT_GT(near[0].size(), 60U);
    for (const NearPatch& each : near[0]) {
        EXPECT_LT(each.distance, patches[each.patch].falloff);
        EXPECT_EQ(each.source, patches[each.patch].vertices.front());
    }
}

TEST(SmallPatches, AStrayBesideALargePartIsOneAndTheLargePartIsNot) {
    Sheet sheet([](const Vec3d& p) { return is_in_disc(p) || is_at(p, 74, 50); });
    const std::vector<SmallPatch> patches = sheet.patches();
    ASSERT_EQ(patches.size(), 1U);
    EXPECT_TRUE(is_at(sheet.cloud.at(patches[0].vertices.front()), 74, 50));
    // What lies nearer to the disc goes by that.
    double leftmost = size, rightmost = 0;
    const Vicinities near = sheet.near(patches);
    for (const NearPatch& each : near[0]) {
        leftmost = std::min(leftmost, sheet.cloud.at(each.vertex).x());
        rightmost = std::max(rightmost, sheet.cloud.at(each.vertex).x());
    }
    EXPECT_GE(leftmost, 72);
    EXPECT_GE(rightmost, 78);
}

TEST(SmallPatches, ASelectionWithHolesIsOneLargeOne) {
    Sheet sheet([](const Vec3d& p) {
        return is_in_disc(p) && std::lround(p.x() + p.y()) % 2 == 0; // every other one
    });
    EXPECT_TRUE(sheet.patches().empty());
}

// A curve that turns back on itself is as thin as a straight one.
TEST(SmallPatches, ALongLineIsThin) {
    Sheet line([](const Vec3d& p) { return std::abs(p.y() - 50) < 0.5 && std::abs(p.x() - 50) <= 30; });
    Sheet ring([](const Vec3d& p) { return std::abs(std::hypot(p.x() - 50, p.y() - 50) - 30) < 0.8; });
    for (Sheet* sheet : {&line, &ring}) {
        const std::vector<SmallPatch> patches = sheet->patches();
        ASSERT_EQ(patches.size(), 1U);
        EXPECT_EQ(patches[0].vertices.size(), static_cast<std::size_t>(std::ranges::count(sheet->label, 0U)));
        EXPECT_NEAR(patches[0].radius, sheet == &line ? 0 : 0.6, 0.5);
        EXPECT_GT(sheet->near(patches)[0].size(), 200U);
    }
}

// But for what is as wide as the disc that is large enough, and what lies along the cloud's own edge, on
// one side of which nothing is.
TEST(SmallPatches, AWideStripIsNone) {
    Sheet narrow([](const Vec3d& p) { return std::abs(p.y() - 49.5) < 1; });
    EXPECT_EQ(narrow.patches().size(), 1U);
    Sheet wide([](const Vec3d& p) { return std::abs(p.y() - 50) < 2.1; });
    EXPECT_TRUE(wide.patches().empty());
    Sheet along_edge([](const Vec3d& p) { return p.y() < 2.1; });
    EXPECT_TRUE(along_edge.patches().empty());
}

TEST(SmallPatches, AStripWithHolesIsAsWideAsWithout) {
    Sheet sheet([](const Vec3d& p) {
        return std::abs(p.y() - 50) < 8.1 && std::lround(p.x()) % 3 + std::lround(p.y()) % 3 > 0;
    });
    EXPECT_TRUE(sheet.patches().empty());
}

TEST(SmallPatches, WhatIsHeldAllAroundPullsNothing) {
    Sheet sheet([](const Vec3d& /*p*/) { return true; });
    EXPECT_TRUE(sheet.patches().empty());
    EXPECT_TRUE(sheet.near({})[0].empty());
}

// How far those are from the point that is held, ascending.
std::vector<double> ways_to_middle(const Cloud& cloud, const std::vector<Index>& vertices) {
    std::vector<double> ways;
    for (const Index v : vertices) ways.push_back((cloud.at(v) - Vec3d(50, 50, 0)).norm());
    std::ranges::sort(ways);
    return ways;
}

TEST(BedSamples, LieAroundAPointAndDenserBesideIt) {
    Sheet sheet([](const Vec3d& p) { return is_at(p, 50, 50); });
    const std::vector<SmallPatch> patches = sheet.patches();
    // As if it were a tenth as large, for spacings that are no smaller than the grid's not to be all there
    // is.
    constexpr double tenth = 0.1;
    const auto chosen = [&](const std::vector<Index>& base, std::size_t most) {
        return bed_samples(patches, sheet.near(patches, base), {}, sheet.cloud.positions, tenth * size, most);
    };
    const std::vector<Index> all = chosen({}, 1000);
    EXPECT_TRUE(all_different(all));
    EXPECT_GT(all.size(), 12U);
    const std::vector<double> ways = ways_to_middle(sheet.cloud, all);
    EXPECT_LT(ways.front(), 2);
    EXPECT_LT(ways.back(), patches[0].falloff);
    const std::vector<Index> some = chosen({}, 5); // the first of them
    EXPECT_TRUE(std::ranges::equal(some, std::span(all).first(5)));
    std::vector<Index> everywhere;
    for (Index v = 0; v < sheet.cloud.size(); ++v)
        if (sheet.label[v] == no_index) everywhere.push_back(v);
    EXPECT_TRUE(chosen(everywhere, 1000).empty());
    for (const Index v : chosen(some, 1000)) EXPECT_EQ(std::ranges::find(some, v), some.end());
}

TEST(BedSamples, AreNoMoreThanThereAreVertices) {
    Sheet sheet([](const Vec3d& p) { return is_at(p, 50, 50); });
    const std::vector<SmallPatch> patches = sheet.patches();
    Vicinities near = sheet.near(patches);
    near[0].resize(1);
    near[0][0].distance = 5; // far from all else
    EXPECT_EQ(bed_samples(patches, near, {}, sheet.cloud.positions, size, 10).size(), 1U);
}

TEST(BedSamples, AreNoOutliers) {
    Sheet sheet([](const Vec3d& p) { return is_at(p, 50, 50); });
    const std::vector<SmallPatch> patches = sheet.patches();
    std::vector<std::uint8_t> hanging(sheet.cloud.size(), 0);
    for (std::size_t v = 0; v < hanging.size(); ++v) hanging[v] = sheet.cloud.at(v).x() > 50;
    const std::vector<Index> chosen =
        bed_samples(patches, sheet.near(patches), hanging, sheet.cloud.positions, size, 100);
    EXPECT_GT(chosen.size(), 3U);
    for (const Index v : chosen) EXPECT_LE(sheet.cloud.at(v).x(), 50);
}

} // namespace
} // namespace knead

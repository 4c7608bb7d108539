#include "upsample/influence_groups.h"

#include "base/workers.h"
#include "graph/balanced_weights.h"
#include "upsample/every_upsampler.h"
#include "upsample/point_blocks.h"

#include <map>

namespace knead::test {

namespace {

using Shares = std::map<Index, int>; // by motion, where it has one

Shares shares_of(const InfluenceGroups& influences, std::size_t point) {
    const InfluenceGroup group = influences.groups()[point / points_in_group];
    Shares shares;
    int left = whole_share;
    const auto note = [&](Index motion, int share) {
        left -= share;
        if (share == 0) return;
        EXPECT_TRUE(shares.emplace(motion, share).second) << "named twice";
    };
    for (Index entry = group.first; entry < group.first + group.count; ++entry)
        note(influences.motion()[entry],
             influences.share()[points_in_group * entry + point % points_in_group]);
    note(group.motion, left);
    return shares;
}

std::vector<Shares> all_shares(const InfluenceGroups& influences, std::size_t points) {
    std::vector<Shares> all;
    for (std::size_t i = 0; i < points; ++i) all.push_back(shares_of(influences, i));
    return all;
}

} // namespace

TEST(InfluenceGroups, HaveTheWeightsOfEveryPoint) {
    Workers workers(2);
    for (const InfluenceWeights weights : {InfluenceWeights::smooth, InfluenceWeights::paper})
        for (const std::size_t points : {std::size_t{1}, std::size_t{257}, std::size_t{5003}}) {
            Scene scene = random_scene(points, 60, 7);
            scene.weights = weights;
            InfluenceGroups influences;
            influences.prepare(scene.input(), workers);
            for (std::size_t i = 0; i < points; ++i) {
                const Influence expected =
                    influence_of(scene.rows, weights, scene.places, scene.mover[i], at(scene.positions, i));
                std::map<Index, double> left;
                for (std::size_t k = 0; k < expected.count; ++k)
                    left[expected.motion.at(k) + 1] += static_cast<double>(expected.weight.at(k));
                if (expected.count == 0) left[0] = 1;
                for (const auto& [motion, share] : shares_of(influences, i)) {
                    EXPECT_GT(share, 0) << "point " << i << ", motion " << motion;
                    left[motion] -= double{1} * share / whole_share;
                }
                for (const auto& [motion, rest] :
                     left) // of eight shares each is rounded, and one makes up for it
                    EXPECT_NEAR(rest, 0, 4.0 / whole_share) << "point " << i << ", motion " << motion;
            }
        }
}

TEST(InfluenceGroups, WhatMovesAPointAloneHasAllOfIt) {
    Workers workers(1);
    Scene scene = random_scene(3000, 400, 8);
    InfluenceGroups influences;
    influences.prepare(scene.input(), workers);
    std::size_t seen = 0;
    for (std::size_t i = 0; i < 3000; ++i) {
        const Influence expected = influence_of(scene.rows, InfluenceWeights::smooth, scene.mover[i]);
        if (expected.count != 1) continue;
        ++seen;
        EXPECT_EQ(shares_of(influences, i), (Shares{{expected.motion[0] + 1, whole_share}}));
    }
    EXPECT_GT(seen, 100U);
}

TEST(InfluenceGroups, NameTheirMotionsInRisingOrder) {
    Workers workers(1);
    const Scene scene = random_scene(3000, 60, 8);
    InfluenceGroups influences;
    influences.prepare(scene.input(), workers);
    for (const InfluenceGroup& group : influences.groups()) {
        Index last = group.motion;
        for (Index entry = group.first; entry < group.first + group.count; ++entry) {
            EXPECT_GT(influences.motion()[entry], last);
            last = influences.motion()[entry];
        }
    }
}

TEST(InfluenceGroups, MadeAgainWhereSomethingChangedAreWhatTheyWouldBeFromNothing) {
    Workers workers(2);
    Scene scene = random_scene(20'000, 300, 9);
    const Scene other = random_scene(20'000, 300, 10);
    auto& rows = std::get<std::vector<NarrowRow>>(scene.rows.rows);
    const auto& other_rows = std::get<std::vector<NarrowRow>>(other.rows.rows);
    const std::size_t points = scene.mover.size();
    for (std::size_t i = 0; i < points; ++i) // neighbours have neighbouring rows, as in a cloud
        if (scene.mover[i] < rows.size()) scene.mover[i] = static_cast<Index>(i * rows.size() / points);
    InfluenceGroups influences;
    influences.prepare(scene.input(), workers);
    for (const std::size_t stride : {40, 11, 5, 1, 30}) { // few blocks, for which there is room, and all
        std::vector<bool> is_other(rows.size(), false);
        for (std::size_t block = stride / 2; block < blocks_of(points); block += stride) {
            const PointRange own = points_of(block, points);
            for (std::size_t i = own.first; i < own.end; ++i)
                if (const Index row = scene.mover[i]; row < rows.size()) {
                    rows[row] = other_rows[(row + stride) % rows.size()];
                    is_other[row] = true;
                }
        }
        std::vector<std::uint8_t> changed(blocks_of(points), 0);
        for (std::size_t i = 0; i < points; ++i)
            if (scene.mover[i] < rows.size() && is_other[scene.mover[i]]) changed[i / points_in_block] = 1;
        UpsampleInput input = scene.input();
        input.changed = changed;
        influences.prepare(input, workers);
        InfluenceGroups fresh;
        fresh.prepare(scene.input(), workers);
        EXPECT_TRUE(all_shares(influences, points) == all_shares(fresh, points)) << stride;
    }
}

class EveryUpsamplerChanged : public EveryUpsampler {};

INSTANTIATE_TEST_SUITE_P(, EveryUpsamplerChanged, all_paths, name_of_path);

TEST_P(EveryUpsamplerChanged, MovesPointsAsFromNothingWhereSomethingElseMovesSomeOfThem) {
    const auto changing = all(), fresh = all();
    for (std::size_t u = 0; u < changing.size(); ++u) {
        Upsampler& upsampler = *changing[u];
        Scene scene = random_scene(3000, 40, 11);
        upsampled(upsampler, scene);
        std::vector<std::uint8_t> changed(blocks_of(scene.mover.size()), 0);
        changed[3] = 1;
        for (std::size_t i = 3 * points_in_block; i < 3 * points_in_block + 100; ++i)
            scene.mover[i] = static_cast<Index>(scene.rows.size()) + 5;
        UpsampleInput input = scene.input();
        input.changed = changed;
        upsampler.prepare(input, scene.motions.size());
        Posed posed{scene.positions, scene.normals};
        upsampler.run(scene.motions, posed.positions, posed.normals, Held::nothing);
        EXPECT_TRUE(same_bits(posed, upsampled(*fresh[u], scene)));
    }
}

} // namespace knead::test

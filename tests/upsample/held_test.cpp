// Frames that go on from the last one: only what moves is written, and no bit is different.

#include "upsample/every_upsampler.h"
#include "upsample/failing_upsampler.h"
#include "upsample/point_blocks.h"

#include <numeric>
#include <set>

namespace knead {
namespace {

using namespace knead::test;

// A random scene in which the last motion, which is none, holds all but some ranges of points.
constexpr std::size_t motions = 40;
Scene scene_with_region(std::size_t points, const std::vector<PointRange>& region, bool with_normals = true) {
    Scene scene = random_scene(points, motions, 31, with_normals);
    const auto outside = static_cast<Index>(scene.rows.size() + motions - 1);
    std::vector<Index> mover(points, outside);
    for (const PointRange& range : region)
        for (std::size_t i = range.first; i < range.end; ++i) mover[i] = scene.mover[i];
    scene.mover = mover;
    scene.motions.back() = Motion{};
    return scene;
}

// Other motions for every frame; the last one stays.
std::vector<Motion> motions_of_frame(unsigned frame) {
    std::vector<Motion> moved = random_scene(1, motions, 100 + frame).motions;
    moved.back() = Motion{};
    return moved;
}

std::vector<Index> blocks_touched(const std::vector<PointRange>& region) {
    std::set<Index> touched;
    for (const PointRange& range : region)
        for (std::size_t i = range.first; i < range.end; ++i)
            touched.insert(static_cast<Index>(i / points_in_block));
    return {touched.begin(), touched.end()};
}

Posed nothing_yet(const Scene& scene) {
    return {std::vector<float>(scene.positions.size(), -1), std::vector<float>(scene.normals.size(), -1)};
}

// One frame, and the blocks that it wrote.
std::vector<Index> frame(Upsampler& upsampler, const std::vector<Motion>& moved, Posed& into,
                         Held held = Held::last_frame) {
    const auto written = upsampler.run(moved, into.positions, into.normals, held);
    return {written.begin(), written.end()};
}

Posed whole_frame(Upsampler& upsampler, Scene scene, const std::vector<Motion>& moved) {
    scene.motions = moved;
    return upsampled(upsampler, scene);
}

std::vector<Index> all_blocks(std::size_t points) {
    std::vector<Index> all(blocks_of(points));
    std::iota(all.begin(), all.end(), Index{0});
    return all;
}

class EveryUpsamplerHeld : public EveryUpsampler {
protected:
    // Frames of every upsampler that go on from each other, each with the bits of a whole one.
    // check(frame, blocks): what it wrote. `motions_of`: those of a frame.
    template<typename MotionsOf, typename Check>
    void expect_same_bits(const Scene& scene, unsigned frames, MotionsOf&& motions_of, Check&& check) {
        const auto upsamplers = all();
        const auto whole = all();
        for (std::size_t u = 0; u < upsamplers.size(); ++u) {
            upsamplers[u]->prepare(scene.input(), motions);
            Posed posed = nothing_yet(scene);
            for (unsigned f = 0; f < frames; ++f) {
                check(f, frame(*upsamplers[u], motions_of(f), posed));
                ASSERT_TRUE(same_bits(posed, whole_frame(*whole[u], scene, motions_of(f)))) << f;
            }
        }
    }
};
INSTANTIATE_TEST_SUITE_P(, EveryUpsamplerHeld, all_paths, name_of_path);

TEST_P(EveryUpsamplerHeld, WritesWhatMovesAndGivesTheSameBits) {
    const std::vector<std::vector<PointRange>> regions = {{},
                                                          {{0, 5003}},
                                                          {{300, 1001}},
                                                          {{256, 512}},
                                                          {{0, 1}, {5002, 5003}},
                                                          {{255, 257}, {1023, 1024}, {4990, 5000}}};
    for (const bool with_normals : {true, false})
        for (const std::vector<PointRange>& region : regions)
            expect_same_bits(scene_with_region(5003, region, with_normals), 5, motions_of_frame,
                             [&](unsigned f, const std::vector<Index>& written) {
                                 EXPECT_EQ(written, f == 0 ? all_blocks(5003) : blocks_touched(region));
                             });
}

// The rest is not touched: whoever breaks the promise sees it.
TEST_P(EveryUpsamplerHeld, LeavesWhatRestsAlone) {
    const Scene scene = scene_with_region(5003, {{300, 1001}});
    for (const auto& upsampler : all()) {
        upsampler->prepare(scene.input(), motions);
        Posed posed = nothing_yet(scene);
        frame(*upsampler, motions_of_frame(0), posed);
        posed.positions[3 * 2000] = posed.normals[3 * 2000] = 77;
        frame(*upsampler, motions_of_frame(1), posed);
        EXPECT_EQ(posed.positions[3 * 2000], 77);
        EXPECT_EQ(posed.normals[3 * 2000], 77);
        frame(*upsampler, motions_of_frame(2), posed, Held::nothing);
        EXPECT_EQ(posed.positions[3 * 2000], scene.positions[3 * 2000]);
        EXPECT_EQ(posed.normals[3 * 2000], scene.normals[3 * 2000]);
    }
}

// So many blocks, and so scattered, that a device fetches some that rest with those that move.
TEST_P(EveryUpsamplerHeld, TakesScatteredRegionsOfLargeClouds) {
    constexpr std::size_t points = 300'007;
    std::vector<PointRange> region;
    for (std::size_t first = 700; first + 9000 < points; first += first % 5 == 0 ? 7919 : 1501)
        region.push_back({first, first + 300});
    expect_same_bits(scene_with_region(points, region), 3, motions_of_frame,
                     [&](unsigned f, const std::vector<Index>& written) {
                         EXPECT_EQ(written, f == 0 ? all_blocks(points) : blocks_touched(region));
                     });
}

TEST_P(EveryUpsamplerHeld, FillsOtherBuffersFirst) {
    const Scene scene = scene_with_region(5003, {{300, 1001}});
    const auto upsamplers = all();
    const auto whole = all();
    for (std::size_t u = 0; u < upsamplers.size(); ++u) {
        upsamplers[u]->prepare(scene.input(), motions);
        Posed posed[] = {nothing_yet(scene), nothing_yet(scene)};
        for (unsigned f = 0; f < 6; ++f) { // two frames into one, two into the other
            frame(*upsamplers[u], motions_of_frame(f), posed[f / 2 % 2]);
            EXPECT_TRUE(same_bits(posed[f / 2 % 2], whole_frame(*whole[u], scene, motions_of_frame(f)))) << f;
        }
        Posed mixed = nothing_yet(scene); // new normals beside old positions, and then the other way round
        upsamplers[u]->run(motions_of_frame(7), posed[0].positions, mixed.normals, Held::last_frame);
        EXPECT_TRUE(same_bits(mixed.normals, whole_frame(*whole[u], scene, motions_of_frame(7)).normals));
        upsamplers[u]->run(motions_of_frame(8), mixed.positions, mixed.normals, Held::last_frame);
        EXPECT_TRUE(same_bits(mixed, whole_frame(*whole[u], scene, motions_of_frame(8))));
    }
}

// What rests in all but two of the frames moves in these.
std::vector<Motion> motions_there_and_back(unsigned f) {
    std::vector<Motion> moved = motions_of_frame(f);
    if (f == 2 || f == 3) moved.back() = moved.front();
    return moved;
}

// As who shows one shape, has the next one waiting, and makes a third.
TEST_P(EveryUpsamplerHeld, GoesOnInEveryBufferThatItFillsInTurn) {
    const Scene scene = scene_with_region(5003, {{300, 1001}});
    const auto upsamplers = all();
    const auto whole = all();
    for (std::size_t u = 0; u < upsamplers.size(); ++u) {
        for (const std::size_t buffers : {2, 3, 4, 5}) {
            upsamplers[u]->prepare(scene.input(), motions);
            std::vector<Posed> posed(buffers, nothing_yet(scene));
            for (unsigned f = 0; f < 12; ++f) {
                Posed& into = posed[f * f % buffers];
                const std::vector<Index> written = frame(*upsamplers[u], motions_there_and_back(f), into);
                EXPECT_TRUE(same_bits(into, whole_frame(*whole[u], scene, motions_there_and_back(f)))) << f;
                // By then all have been filled since what rests came back.
                if (f == 11 && buffers <= 3) {
                    EXPECT_EQ(written, blocks_touched({{300, 1001}})) << buffers;
                }
            }
        }
    }
}

TEST_P(EveryUpsamplerHeld, MovesWhatRestedAsSoonAsItMoves) {
    expect_same_bits(scene_with_region(5003, {{300, 1001}}), 5, motions_there_and_back,
                     [](unsigned f, const std::vector<Index>& written) {
                         // what moves all is not twice the same
                         EXPECT_EQ(written.size() == blocks_of(5003), f != 1) << f;
                     });
}

// As duplicates of one point are: a row of influences is no lone motion.
TEST_P(EveryUpsamplerHeld, MovesBlocksOfOneVertex) {
    Scene scene = scene_with_region(5003, {});
    std::fill(scene.mover.begin() + 1000, scene.mover.begin() + 3000, Index{5});
    expect_same_bits(scene, 3, motions_of_frame, [](unsigned f, const std::vector<Index>& written) {
        EXPECT_EQ(written, f == 0 ? all_blocks(5003) : blocks_touched({{1000, 3000}}));
    });
}

TEST_P(EveryUpsamplerHeld, HoldsNothingThroughAPrepare) {
    Scene scene = scene_with_region(5003, {{300, 1001}});
    const auto upsamplers = all();
    const auto whole = all();
    for (std::size_t u = 0; u < upsamplers.size(); ++u) {
        Posed posed = nothing_yet(scene);
        for (unsigned f = 0; f < 3; ++f) {
            for (float& coordinate : scene.positions) coordinate *= 0.5F;
            upsamplers[u]->prepare(scene.input(), motions);
            EXPECT_EQ(frame(*upsamplers[u], motions_of_frame(f), posed), all_blocks(5003));
            ASSERT_TRUE(same_bits(posed, whole_frame(*whole[u], scene, motions_of_frame(f)))) << f;
        }
    }
}

TEST(FallbackUpsampler, HoldsNothingOfAFrameThatFailed) {
    Workers workers(2);
    const Scene scene = scene_with_region(5003, {{300, 1001}});
    const auto reference = make_reference_upsampler(workers);
    for (const int failing_call : {2, 3, 4}) { // the first is prepare()
        const auto upsampler = make_fallback_upsampler(
            std::make_unique<FailingUpsampler>(make_reference_upsampler(workers), failing_call), workers);
        upsampler->prepare(scene.input(), motions);
        Posed posed = nothing_yet(scene);
        for (unsigned f = 0; f < 4; ++f) {
            frame(*upsampler, motions_of_frame(f), posed);
            EXPECT_TRUE(same_bits(posed, whole_frame(*reference, scene, motions_of_frame(f)))) << f;
        }
    }
}

TEST(PointBlocks, AreTakenTogetherInFewRanges) {
    for (const std::size_t points : {std::size_t{1}, std::size_t{300}, std::size_t{100'003},
                                     std::size_t{1'000'000}, std::size_t{20'000'123}})
        for (const std::size_t step : {1U, 2U, 3U, 63U, 64U, 65U, 600U}) {
            std::vector<PointRange> ranges;
            std::size_t wanted = 0;
            for (std::size_t block = 0; block < blocks_of(points); block += step) {
                append_block(block, points, ranges);
                const PointRange own = points_of(block, points);
                ASSERT_LE(ranges.back().first, own.first);
                ASSERT_EQ(ranges.back().end, own.end);
                wanted += own.end - own.first;
            }
            EXPECT_LE(ranges.size(), most_ranges);
            std::size_t held = 0;
            for (std::size_t r = 0; r < ranges.size(); ++r) {
                EXPECT_GT(ranges[r].first + (r == 0 ? 1 : 0), r == 0 ? 0 : ranges[r - 1].end);
                held += ranges[r].end - ranges[r].first;
            }
            EXPECT_GE(held, wanted);
            if (blocks_of(points) < most_ranges) {
                EXPECT_EQ(held, wanted);
            }
        }
}

} // namespace
} // namespace knead

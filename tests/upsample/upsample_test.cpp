// What every Upsampler promises, asked of the reference, of every OpenCL device, and of every OpenCL device
// made to copy as a GPU does.

#include "base/large_pages.h"
#include "base/require.h"
#include "upsample/every_upsampler.h"

#include <algorithm>
#include <string>
#include <string_view>

namespace knead {

namespace embedded {
extern const char* const upsample_kernel;
}

namespace {

using namespace knead::test;

constexpr double epsilon = 1.2e-7; // one step of a float at 1
// In a random scene every value that is summed is below 4 (A) or 2 (p and b); a row of eight, then three
// products, then the point, are 12 rounded steps or so.
constexpr double position_tolerance = 40 * 4 * epsilon;
// A weight is kept to half a 65,535th, the heaviest to seven halves, and motions lie less than 4 apart.
constexpr double blend_tolerance = position_tolerance + influences_per_row * 4 / 65535.0;
// The blend of rotations has a norm of at most 1, so the cofactor's rounding is about twice that of the map,
// and normalising divides it by the length of the product, below which normals are not compared.
constexpr double least_length = 0.1;
constexpr double normal_tolerance = 2 * blend_tolerance / least_length;

INSTANTIATE_TEST_SUITE_P(, EveryUpsampler, all_paths, name_of_path);

// Rows that only fit WideRow; half of the numbers that they name are handles.
Scene wide_scene() {
    Scene scene = random_scene(2000, 70'000, 14);
    widen(scene.rows);
    scene.rows.first_handle = 68'000;
    auto& rows = std::get<std::vector<WideRow>>(scene.rows.rows);
    for (std::size_t r = 0; r < rows.size(); ++r)
        for (std::size_t k = 0; k < rows[r].count(); ++k) {
            rows[r].sample.at(k) = static_cast<Index>(69'999 - (r + k) % 4000);
            if (rows[r].distance.at(k) != 0) rows[r].distance.at(k) *= 1'000'003; // up to 2^31.5
        }
    return scene;
}

TEST_P(EveryUpsampler, LeavesEveryBitWhereNothingMoves) {
    Scene scene = random_scene(1001, 40, 1);
    scene.motions.assign(40, Motion{});
    scene.positions[0] = -0.0F;
    scene.normals[4] = -0.0F;
    scene.positions[6] = 1e30F;
    for (const auto& upsampler : all())
        EXPECT_TRUE(same_bits(upsampled(*upsampler, scene), Posed{scene.positions, scene.normals}))
            << upsampler->device();
}

TEST_P(EveryUpsampler, FollowsTheFormulas) {
    for (const std::size_t points : {std::size_t{1}, std::size_t{2}, std::size_t{255}, std::size_t{256},
                                     std::size_t{257}, std::size_t{20'011}})
        for (const InfluenceWeights weights : {InfluenceWeights::smooth, InfluenceWeights::paper}) {
            Scene scene = random_scene(points, 50, 2);
            scene.weights = weights;
            for (const auto& upsampler : all()) {
                const Posed posed = upsampled(*upsampler, scene);
                for (std::size_t i = 0; i < points; ++i) {
                    ASSERT_LT((at(posed.positions, i) - exact_position(scene, i)).norm(), blend_tolerance)
                        << i;
                    ASSERT_NEAR(at(posed.normals, i).norm(), 1, 10 * epsilon) << i;
                    const Vec3d turned = exact_turned(scene, i);
                    if (turned.norm() < least_length) continue;
                    ASSERT_LT((at(posed.normals, i) - turned.normalized()).norm(), normal_tolerance) << i;
                }
            }
        }
}

// The kernel, made to write past the caches however few points there are.
std::string streaming_kernel() {
    constexpr std::string_view from = "#define STREAMED_POINTS ";
    std::string text = embedded::upsample_kernel;
    const std::size_t at = text.find(from);
    require(at != std::string::npos, "the kernel says from how many points on it streams");
    return text.insert(at + from.size(), "0 //");
}

TEST_P(EveryUpsampler, WritesTheSamePastTheCachesAndIntoThem) {
    const Scene scene = random_scene(5003, 50, 16);
    const std::string kernel = streaming_kernel();
    const auto streaming = all(0, kernel.c_str());
    const auto usual = all();
    for (std::size_t u = 0; u < usual.size(); ++u)
        for (const std::size_t begin : {0, 1}) { // at a line of the cache, and not
            LineArray<float> positions(begin + scene.positions.size()), normals(positions.size());
            const auto behind = [&](LineArray<float>& array) { return std::span(array).subspan(begin); };
            streaming[u]->prepare(scene.input(), scene.motions.size());
            streaming[u]->run(scene.motions, behind(positions), behind(normals), Held::nothing);
            const Posed expected = upsampled(*usual[u], scene);
            EXPECT_TRUE(std::ranges::equal(behind(positions), expected.positions)) << begin;
            EXPECT_TRUE(std::ranges::equal(behind(normals), expected.normals)) << begin;
        }
}

TEST_P(EveryUpsampler, MovesEverythingRigidlyByOneMotion) {
    Scene scene = random_scene(3001, 30, 3);
    const Mat3d turn = Eigen::AngleAxisd(1.9, Vec3d(1, 2, -1).normalized()).toRotationMatrix();
    const Vec3d shift(0.5, -0.25, 0.75);
    for (Motion& motion : scene.motions) // each of another place, which must not matter
        std::ranges::copy(motion_of(turn, shift).map, motion.map);
    for (const auto& upsampler : all()) {
        const Posed posed = upsampled(*upsampler, scene);
        for (std::size_t i = 0; i < scene.mover.size(); ++i) {
            ASSERT_LT((at(posed.positions, i) - (turn * at(scene.positions, i) + shift)).norm(),
                      position_tolerance);
            ASSERT_LT((at(posed.normals, i) - turn * at(scene.normals, i)).norm(), position_tolerance);
        }
    }
}

TEST_P(EveryUpsampler, KeepsNormalsPerpendicularUnderScaling) {
    Scene scene = random_scene(2000, 1, 4);
    Mat3d linear;
    linear << 2, 0.3, 0, -0.1, 0.5, 0.2, 0, 0, 3; // a handle may scale by axes, and then be turned
    scene.motions.assign(1, motion_of(linear, Vec3d::Zero()));
    for (const auto& upsampler : all()) {
        const Posed posed = upsampled(*upsampler, scene);
        for (std::size_t i = 0; i < scene.mover.size(); ++i) {
            const Vec3d normal = at(scene.normals, i);
            const Vec3d tangent = linear * normal.unitOrthogonal();
            ASSERT_NEAR(at(posed.normals, i).dot(tangent.normalized()), 0, position_tolerance);
            ASSERT_GT(at(posed.normals, i).dot(linear * normal), 0); // still on the same side
        }
    }
}

TEST_P(EveryUpsampler, KeepsTheLengthOfNormals) {
    Scene scene = random_scene(600, 20, 5);
    for (std::size_t i = 0; i < scene.normals.size(); ++i)
        scene.normals[i] *= i / 3 % 2 == 0 ? 1e-6F : 300.0F;
    for (std::size_t i = 30; i < 33; ++i) scene.normals[i] = 0;
    for (const auto& upsampler : all()) {
        const Posed posed = upsampled(*upsampler, scene);
        for (std::size_t i = 0; i < scene.mover.size(); ++i) {
            const double length = at(scene.normals, i).norm();
            ASSERT_NEAR(at(posed.normals, i).norm(), length, 10 * epsilon * length);
        }
        EXPECT_EQ(at(posed.normals, 10), Vec3d::Zero().eval());
    }
}

TEST_P(EveryUpsampler, KeepsANormalThatTheMapFlattens) {
    Scene scene = random_scene(10, 1, 6);
    scene.motions.assign(1, motion_of(Mat3d::Zero(), Vec3d(1, 2, 3)));
    for (const auto& upsampler : all()) {
        const Posed posed = upsampled(*upsampler, scene);
        EXPECT_TRUE(same_bits(posed.normals, scene.normals));
        for (std::size_t i = 0; i < 10; ++i)
            EXPECT_LT((at(posed.positions, i) - Vec3d(1, 2, 3)).norm(), position_tolerance);
    }
}

TEST_P(EveryUpsampler, TakesCloudsWithoutNormalsAndWithoutPoints) {
    const Scene bare = random_scene(777, 9, 7, false);
    const Scene full = random_scene(777, 9, 7, true);
    const Scene empty = random_scene(0, 9, 7);
    for (const auto& upsampler : all()) {
        const Posed without = upsampled(*upsampler, bare);
        EXPECT_TRUE(without.normals.empty());
        for (std::size_t i = 0; i < 777; ++i)
            ASSERT_LT((at(without.positions, i) - exact_position(bare, i)).norm(), blend_tolerance);
        EXPECT_TRUE(upsampled(*upsampler, empty).positions.empty());
        upsampler->prepare(full.input(), full.motions.size()); // and with both again, after neither
        EXPECT_EQ(upsampled(*upsampler, full).normals.size(), 3 * 777U);
    }
}

TEST_P(EveryUpsampler, GivesTheSameBytesAgainAndOnAnyNumberOfThreads) {
    const Scene scene = random_scene(100'003, 500, 8);
    std::vector<Posed> expected;
    for (const auto& upsampler : all(1)) expected.push_back(upsampled(*upsampler, scene));
    for (const unsigned threads : {1U, 2U, 0U}) {
        const auto upsamplers = all(threads);
        for (std::size_t i = 0; i < upsamplers.size(); ++i) {
            Posed posed = upsampled(*upsamplers[i], scene);
            EXPECT_TRUE(same_bits(posed, expected[i])) << threads << " threads";
            std::fill(posed.positions.begin(), posed.positions.end(), 0.0F);
            upsamplers[i]->run(scene.motions, posed.positions, posed.normals, Held::nothing);
            EXPECT_TRUE(same_bits(posed, expected[i])) << threads << " threads, again";
        }
    }
}

// Five steps of a float, for devices that fuse products and sums, round quotients and roots less exactly, or
// flush tiny numbers to zero; of normals, which maps that nearly flatten them magnify, twice as many.
TEST_P(EveryUpsampler, AgreesWithTheReference) {
    std::vector<Scene> scenes{random_scene(50'021, 300, 9), random_scene(50'021, 300, 9), wide_scene()};
    scenes[1].weights = InfluenceWeights::paper;
    for (const Scene& scene : scenes) {
        Workers workers(2);
        const Posed expected = upsampled(*make_reference_upsampler(workers), scene);
        for (const auto& upsampler : all()) {
            const Posed posed = upsampled(*upsampler, scene);
            for (std::size_t i = 0; i < posed.positions.size(); ++i) {
                ASSERT_NEAR(posed.positions[i], expected.positions[i], 5 * epsilon) << i;
                ASSERT_NEAR(posed.normals[i], expected.normals[i], 10 * epsilon) << i;
            }
        }
    }
}

class UnfusedKernel : public EveryUpsampler {};

INSTANTIATE_TEST_SUITE_P(, UnfusedKernel, ::testing::Values(Path::device, Path::device_with_own_memory),
                         name_of_path);

// On PoCL: so a slip of a single operation shows.
TEST_P(UnfusedKernel, AgreesWithTheReferenceToTheBit) {
    std::string kernel = embedded::upsample_kernel;
    const std::string fused = "#pragma OPENCL FP_CONTRACT ON";
    ASSERT_NE(kernel.find(fused), std::string::npos);
    while (kernel.find(fused) != std::string::npos)
        kernel.replace(kernel.find(fused), fused.size(), "#pragma OPENCL FP_CONTRACT OFF");
    const auto devices = all(0, kernel.c_str());
    const auto is_pocl = [descriptions = list_devices()](const auto& device) {
        return std::ranges::any_of(descriptions, [&](const DeviceDescription& one) {
            return one.name == device->device() && one.platform.find("Portable") != std::string::npos;
        });
    };
    if (std::ranges::none_of(devices, is_pocl)) GTEST_SKIP() << "there is no PoCL";
    Workers workers(2);
    const auto reference = make_reference_upsampler(workers);
    std::vector<Scene> scenes{random_scene(50'021, 300, 9), random_scene(50'021, 300, 9), wide_scene()};
    scenes[1].weights = InfluenceWeights::paper;
    for (const Scene& scene : scenes)
        for (const auto& device : devices) {
            if (!is_pocl(device)) continue;
            EXPECT_TRUE(same_bits(upsampled(*device, scene), upsampled(*reference, scene)));
        }
}

TEST_P(EveryUpsampler, ReadsNarrowAndWideRowsAlike) {
    for (const InfluenceWeights weights : {InfluenceWeights::smooth, InfluenceWeights::paper}) {
        Scene narrow = random_scene(10'007, 300, 13);
        narrow.weights = weights;
        Scene wide = narrow;
        widen(wide.rows);
        ASSERT_TRUE(wide.rows.are_wide() && !narrow.rows.are_wide());
        for (const auto& upsampler : all()) { // one after the other, so that it has to change
            const Posed first = upsampled(*upsampler, narrow);
            EXPECT_TRUE(same_bits(upsampled(*upsampler, wide), first));
            EXPECT_TRUE(same_bits(upsampled(*upsampler, narrow), first));
        }
    }
}

TEST_P(EveryUpsampler, TakesDistancesAndSamplesThatOnlyWideRowsHold) {
    const Scene scene = wide_scene();
    for (const auto& upsampler : all()) {
        const Posed posed = upsampled(*upsampler, scene);
        for (std::size_t i = 0; i < scene.mover.size(); ++i)
            ASSERT_LT((at(posed.positions, i) - exact_position(scene, i)).norm(), blend_tolerance) << i;
    }
}

TEST_P(EveryUpsampler, MovesEveryPointByAMotionOfItsOwnWithoutRows) {
    Scene scene = random_scene(3000, 3000, 15);
    scene.rows = {};
    for (Index i = 0; i < 3000; ++i) scene.mover[i] = 2999 - i;
    for (const auto& upsampler : all()) {
        const Posed posed = upsampled(*upsampler, scene);
        for (std::size_t i = 0; i < 3000; ++i)
            ASSERT_LT((at(posed.positions, i) - exact_position(scene, i)).norm(), blend_tolerance) << i;
    }
}

TEST_P(EveryUpsampler, LeavesEveryBitOfAPointWhoseRowIsEmpty) {
    Scene scene = random_scene(500, 20, 16);
    std::get<std::vector<NarrowRow>>(scene.rows.rows)[3] = {
        {65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535},
        {65535, 65535, 65535, 65535, 65535, 65535, 65535, 65535}};
    scene.mover.assign(500, 3);
    scene.positions[1] = -0.0F;
    for (int kind = 0; kind < 2; ++kind) {
        for (const auto& upsampler : all())
            EXPECT_TRUE(same_bits(upsampled(*upsampler, scene), Posed{scene.positions, scene.normals}));
        widen(scene.rows);
    }
}

TEST_P(EveryUpsampler, TakesNewMotionsAndOtherArraysEveryFrame) {
    Scene scene = random_scene(5000, 60, 10);
    const std::vector<Motion> other = random_scene(1, 60, 11).motions;
    for (const auto& upsampler : all()) {
        const Posed first = upsampled(*upsampler, scene);
        Posed a = first;
        Posed b = first;
        upsampler->run(other, a.positions, a.normals, Held::nothing);
        upsampler->run(scene.motions, b.positions, b.normals, Held::nothing);
        EXPECT_FALSE(same_bits(a, first));
        EXPECT_TRUE(same_bits(b, first));
        upsampler->run(scene.motions, a.positions, a.normals,
                       Held::nothing); // into the array of two frames ago
        EXPECT_TRUE(same_bits(a, first));
    }
}

TEST_P(EveryUpsampler, RefusesRowsAndSamplesThatDoNotExist) {
    for (const auto& upsampler : all()) {
        Scene scene = random_scene(10, 5, 12);
        EXPECT_THROW(upsampler->prepare(scene.input(), 0), BrokenInvariant);
        scene.mover[3] = static_cast<Index>(scene.rows.size() + 5);
        EXPECT_THROW(upsampler->prepare(scene.input(), 5), BrokenInvariant);
        scene.mover[3] = no_index;
        EXPECT_THROW(upsampler->prepare(scene.input(), 5), BrokenInvariant);
        scene.mover[3] = 0;
        std::get<std::vector<NarrowRow>>(scene.rows.rows)[1].sample[0] = 5;
        EXPECT_THROW(upsampler->prepare(scene.input(), 5), BrokenInvariant);
        std::get<std::vector<NarrowRow>>(scene.rows.rows)[1].sample[0] = 4;
        upsampler->prepare(scene.input(), 5);
        std::vector<float> places(30);
        EXPECT_THROW(upsampler->run(scene.motions, places, {}, Held::nothing), BrokenInvariant);
        EXPECT_THROW(upsampler->run({}, places, places, Held::nothing), BrokenInvariant);
    }
}

TEST_P(EveryUpsampler, TakesTheWordOfWhoKnowsWhereNumbersEnd) {
    for (const auto& upsampler : all()) {
        const Scene scene = random_scene(1000, 5, 12);
        UpsampleInput input = scene.input();
        input.rows_end = 5;
        upsampler->prepare(input, 5);
        EXPECT_THROW(upsampler->prepare(input, 4), BrokenInvariant);
        input.rows_end = 6;
        EXPECT_THROW(upsampler->prepare(input, 5), BrokenInvariant);
        input.rows_end = 5;
        input.mover_end = scene.rows.size() + 5;
        upsampler->prepare(input, 5);
        input.mover_end = scene.rows.size() + 6;
        EXPECT_THROW(upsampler->prepare(input, 5), BrokenInvariant);
    }
}

} // namespace
} // namespace knead

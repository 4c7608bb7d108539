// Frames that whoever draws moves the points by: the same points as of run(), and boxes around them.

#include "upsample/drawing.h"
#include "upsample/every_upsampler.h"
#include "upsample/point_blocks.h"

#include <cmath>
#include <limits>

namespace knead {
namespace {

using namespace knead::test;

class DrawnFrames : public EveryUpsampler {
protected:
    // Of what `drawn` moved last.
    static Posed read(DrawnPoints& drawn, const Scene& scene) {
        Posed posed{std::vector<float>(scene.positions.size()), std::vector<float>(scene.normals.size())};
        drawn.read(posed.positions, posed.normals);
        return posed;
    }
};

// A frame of a scene that the upsampler is prepared for.
Posed run(Upsampler& upsampler, const Scene& scene, const std::vector<Motion>& motions) {
    Posed posed{std::vector<float>(scene.positions.size()), std::vector<float>(scene.normals.size())};
    upsampler.run(motions, posed.positions, posed.normals, Held::nothing);
    return posed;
}

PointBox box_of(const std::vector<float>& positions, const PointRange& points) {
    constexpr float huge = std::numeric_limits<float>::max();
    PointBox box{huge, huge, huge, -huge, -huge, -huge};
    for (std::size_t i = points.first; i < points.end; ++i) {
        const float* p = positions.data() + 3 * i;
        if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2])) continue;
        for (std::size_t axis = 0; axis < 3; ++axis) {
            box[axis] = std::min(box[axis], p[axis]);
            box[3 + axis] = std::max(box[3 + axis], p[axis]);
        }
    }
    return box;
}

TEST_P(DrawnFrames, HaveTheBitsOfTheOthers) {
    for (const bool with_normals : {true, false})
        for (const std::size_t points : {1U, 3U, 255U, 257U, 1025U, 20000U}) {
            const Scene scene = random_scene(points, 40, 51, with_normals);
            for (const auto& upsampler : all()) {
                const Posed expected = upsampled(*upsampler, scene);
                DrawnPoints drawn;
                drawn.move(*upsampler->frame(scene.motions), Held::nothing);
                EXPECT_TRUE(same_bits(read(drawn, scene), expected)) << points << " points";
            }
        }
}

TEST_P(DrawnFrames, GoOnFromTheLastOne) {
    const std::size_t points = 20000;
    Scene scene = random_scene(points, 40, 52);
    for (std::size_t i = 1000; i < 15000; ++i) scene.mover[i] = static_cast<Index>(scene.rows.size() + 39);
    for (const auto& upsampler : all()) {
        upsampled(*upsampler, scene);
        DrawnPoints drawn;
        for (unsigned frame = 0; frame < 4; ++frame) {
            std::vector<Motion> motions = random_scene(1, 40, 60 + frame).motions;
            motions.back() = scene.motions[frame / 2]; // every other time as it was
            drawn.move(*upsampler->frame(motions), Held::last_frame);
            EXPECT_TRUE(same_bits(read(drawn, scene), run(*upsampler, scene, motions))) << frame;
        }
    }
}

TEST_P(DrawnFrames, TellTheBoxesOfAllBlocks) {
    const std::size_t points = 5 * points_in_block + 77;
    Scene scene = random_scene(points, 40, 53);
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    scene.positions[3 * 700] = nan;
    for (std::size_t i = 2 * points_in_block; i < 3 * points_in_block; ++i)
        scene.positions[3 * i + i % 3] = std::numeric_limits<float>::infinity();
    for (const auto& upsampler : all()) {
        const Posed expected = upsampled(*upsampler, scene);
        DrawnPoints drawn;
        drawn.move(*upsampler->frame(scene.motions), Held::nothing);
        ASSERT_EQ(drawn.boxes().size(), 6U);
        for (std::size_t block = 0; block < 6; ++block)
            EXPECT_EQ(drawn.boxes()[block], box_of(expected.positions, points_of(block, points))) << block;
    }
}

TEST_P(DrawnFrames, StayGoodWhateverBecomesOfTheirUpsampler) {
    const Scene scene = random_scene(3000, 40, 54), other = random_scene(500, 7, 55);
    for (auto& upsampler : all()) {
        const Posed expected = upsampled(*upsampler, scene);
        const auto first = upsampler->frame(scene.motions);
        const Posed expected_later = upsampled(*upsampler, other);
        const auto second = upsampler->frame(other.motions);
        upsampler.reset();
        DrawnPoints drawn;
        drawn.move(*second, Held::last_frame);
        EXPECT_TRUE(same_bits(read(drawn, other), expected_later));
        drawn.move(*first, Held::last_frame);
        EXPECT_TRUE(same_bits(read(drawn, scene), expected));
    }
}

INSTANTIATE_TEST_SUITE_P(, DrawnFrames, ::testing::Values(Path::device_with_own_memory), name_of_path);

TEST(DrawnFrame, IsNotToBeHadWherePointsStayInTheProcessorsMemory) {
    Workers workers(2);
    const Scene scene = random_scene(300, 40, 56);
    const auto reference = make_reference_upsampler(workers);
    upsampled(*reference, scene);
    EXPECT_EQ(reference->frame(scene.motions), nullptr);
    EXPECT_FALSE(reference->shares_with_opengl());
    const auto devices = list_devices();
    for (std::size_t i = 0; i < devices.size(); ++i) {
        const UpsamplerChoice choice = make_upsampler(std::to_string(i), workers, 0);
        upsampled(*choice.upsampler, scene);
        const bool has_own = devices[i].type != DeviceType::cpu;
        EXPECT_EQ(choice.upsampler->frame(scene.motions) != nullptr, has_own);
        EXPECT_FALSE(choice.upsampler->shares_with_opengl()) << "nobody draws";
    }
    EXPECT_EQ(share_with_current_gl_context(), nullptr);
}

} // namespace
} // namespace knead

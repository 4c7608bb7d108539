// Points that OpenCL moves in the buffers that OpenGL draws them from. It needs a display on a graphics card
// whose driver shares the one's memory with the other.

#include "app/window.h"
#include "base/workers.h"
#include "render/point_renderer.h"
#include "support/comparing.h"
#include "upsample/devices.h"
#include "upsample/point_blocks.h"
#include "upsample/scene.h"

#include <epoxy/gl.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <thread>

namespace knead::test {

namespace {

std::vector<float> contents(unsigned buffer, std::size_t floats) {
    std::vector<float> values(floats);
    glBindBuffer(GL_ARRAY_BUFFER, buffer);
    glGetBufferSubData(GL_ARRAY_BUFFER, 0, static_cast<GLsizeiptr>(floats * sizeof(float)), values.data());
    return values;
}

// On the device that shares; null where none of them does.
std::unique_ptr<Upsampler> sharing_upsampler(const Scene& scene, Workers& workers,
                                             const std::shared_ptr<const GlSharing>& sharing) {
    std::unique_ptr<Upsampler> found;
    std::thread document([&] { // as it is in the window
        for (std::size_t i = 0; i < list_devices().size() && !found; ++i) {
            auto upsampler = make_opencl_upsampler(i, workers, 0, {.sharing = sharing});
            upsampler->prepare(scene.input(), scene.motions.size());
            if (upsampler->shares_with_opengl()) found = std::move(upsampler);
        }
    });
    document.join();
    return found;
}

} // namespace

TEST(DrawnOnDevice, PointsAreWhereRunWouldHavePutThem) {
    if (!std::getenv("DISPLAY")) GTEST_SKIP() << "there is no display";
    const Window window(320, 200);
    const auto sharing = share_with_current_gl_context();
    if (!sharing) GTEST_SKIP() << "no OpenCL device shares memory with OpenGL on " << window.drawn_by();
    Workers workers(2);
    for (const bool with_normals : {true, false}) {
        Scene scene = random_scene(5000, 40, 71, with_normals);
        for (std::size_t i = 1000; i < 4000; ++i) // by a motion that stays: written once
            scene.mover[i] = static_cast<Index>(scene.rows.size() + 39);
        const Motion staying = scene.motions.back();
        const auto upsampler = sharing_upsampler(scene, workers, sharing);
        ASSERT_NE(upsampler, nullptr);
        PointRenderer renderer(PointRenderer::Drawing::by_opengl);
        renderer.set_points(5000, 0.1);
        EXPECT_EQ(renderer.buffers_to_write().positions, 0U) << "nothing is there to draw";
        renderer.set_positions(scene.positions);
        renderer.set_normals(scene.normals);
        DrawnPoints drawn;
        for (unsigned frame = 0; frame < 3; ++frame) {
            scene.motions = random_scene(1, 40, 80 + frame).motions;
            scene.motions.back() = staying;
            std::shared_ptr<const DeviceFrame> made;
            std::thread document([&] { made = upsampler->frame(scene.motions); });
            document.join();
            const auto buffers = renderer.buffers_to_write();
            drawn.move(*made, {buffers.positions, buffers.normals}, Held::last_frame);
            renderer.note_written(drawn.boxes(), points_in_block);
            Posed expected{std::vector<float>(scene.positions.size()),
                           std::vector<float>(scene.normals.size())};
            upsampler->run(scene.motions, expected.positions, expected.normals, Held::nothing);
            EXPECT_TRUE(same_bits(contents(buffers.positions, 15000), expected.positions)) << frame;
            if (with_normals) {
                EXPECT_TRUE(same_bits(contents(buffers.normals, 15000), expected.normals)) << frame;
            }
            EXPECT_TRUE(renderer.draw({}, {320, 200}, {}, 5000, 0).complete);
        }
    }
}

} // namespace knead::test

#include "view/framing.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace knead::test {
namespace {

std::vector<float> grid(int side, float spacing) {
    std::vector<float> positions;
    for (int x = 0; x < side; ++x)
        for (int y = 0; y < side; ++y)
            for (const float value : {spacing * static_cast<float>(x), spacing * static_cast<float>(y), 0.0f})
                positions.push_back(value);
    return positions;
}

TEST(Framing, the_box_of_an_even_cloud_is_its_bounding_box) {
    const Box3 box = bulk_box(grid(100, 0.5f));
    EXPECT_EQ(box.lowest, glm::dvec3(0));
    EXPECT_EQ(box.highest, glm::dvec3(49.5, 49.5, 0));
}

TEST(Framing, stray_points_do_not_make_the_box_large) {
    std::vector<float> positions = grid(100, 0.5f);
    for (const float far : {1000.0f, -1000.0f}) positions.insert(positions.end(), {far, far, far});
    const Box3 box = bulk_box(positions);
    EXPECT_GT(box.lowest.x, -10);
    EXPECT_LT(box.highest.x, 60);
    EXPECT_EQ(box.highest.z, 0);
}

TEST(Framing, fills_the_view_from_every_side) {
    const Viewport viewport{400, 300};
    const std::vector<float> positions = grid(50, 0.1f);
    for (const Side side : {Side::top, Side::front, Side::right}) {
        Camera camera;
        look_at_side(camera, side);
        camera.orientation = camera.orientation * glm::angleAxis(0.6, glm::dvec3(0, 0, 1));
        frame_points(camera, positions, viewport);
        double left = 1e9, right = -1e9, top = 1e9, bottom = -1e9;
        for (std::size_t i = 0; i < positions.size(); i += 3) {
            const glm::dvec2 pixel =
                project(camera, viewport, {positions[i], positions[i + 1], positions[i + 2]})->pixel;
            left = std::min(left, pixel.x), right = std::max(right, pixel.x);
            top = std::min(top, pixel.y), bottom = std::max(bottom, pixel.y);
        }
        EXPECT_GT(left, 0);
        EXPECT_LT(right, 400);
        EXPECT_GT(top, 0);
        EXPECT_LT(bottom, 300);
        EXPECT_TRUE(right - left > 0.75 * 400 || bottom - top > 0.75 * 300);
    }
    Camera camera;
    frame_points(camera, {}, viewport); // of no points: anything that is a camera
    EXPECT_GT(camera.distance, 0);
}

TEST(Framing, takes_clouds_of_hardly_any_points) {
    EXPECT_EQ(bulk_box({}).highest, glm::dvec3(0.5));
    const std::vector<float> one = {1, 2, 3};
    EXPECT_EQ(bulk_box(one).lowest, glm::dvec3(1, 2, 3));
    EXPECT_GT(usual_spacing({}), 0);
    EXPECT_GT(usual_spacing(one), 0);
    const std::vector<float> equal(30, 4.0f);
    EXPECT_GT(usual_spacing(equal), 0);
}

TEST(Framing, the_spacing_of_a_grid_is_about_its_own) {
    // Row by row, and the next row is within the window of neighbours in memory only for short rows.
    const double spacing = usual_spacing(grid(12, 0.25f));
    EXPECT_GE(spacing, 0.25);
    EXPECT_LE(spacing, 0.5);
}

} // namespace
} // namespace knead::test

#include "headless_scene.h"

#include "render/png.h"
#include "support/scratch_folder.h"

#include <png.h>

namespace knead::test {
namespace {

struct Read {
    unsigned width = 0, height = 0;
    std::vector<std::uint8_t> rgb;
};

Read read_png(const std::filesystem::path& path) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    EXPECT_NE(png_image_begin_read_from_file(&image, path.c_str()), 0) << image.message;
    EXPECT_EQ(image.format, static_cast<png_uint_32>(PNG_FORMAT_RGB));
    Read read{image.width, image.height, std::vector<std::uint8_t>(PNG_IMAGE_SIZE(image))};
    EXPECT_NE(png_image_finish_read(&image, nullptr, read.rgb.data(), 0, nullptr), 0) << image.message;
    return read;
}

TEST(Png, holds_what_was_written) {
    const ScratchFolder folder;
    Picture picture{5, 3, {}};
    for (int i = 0; i < 45; ++i) picture.rgb.push_back(static_cast<std::uint8_t>(5 * i));
    write_png(folder / "a.png", picture);
    const Read read = read_png(folder / "a.png");
    EXPECT_EQ(read.width, 5U);
    EXPECT_EQ(read.height, 3U);
    EXPECT_EQ(read.rgb, picture.rgb);
}

TEST(Png, a_folder_that_is_not_there_is_an_error) {
    try {
        write_png("/nowhere/at/all/a.png", {1, 1, {0, 0, 0}});
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::output);
    }
}

class Pictures : public HeadlessScene {};

TEST_P(Pictures, are_the_scene_from_the_top_row_on_however_finely_drawn) {
    const Viewport size{80, 60};
    const Camera camera = first_view({glm::dvec3(-1), glm::dvec3(1)}, size);
    renderer->set_points(1, 0.1);
    const std::vector<float> point = {0, 0, 0.8f}; // in the upper half
    renderer->set_positions(point);
    renderer->set_colors(std::vector{rgba(0, 255, 0)});
    flat.pixels = 9;
    const glm::dvec2 pixel = project(camera, size, {0, 0, 0.8f})->pixel;
    ASSERT_LT(pixel.y, 30);
    for (const int supersampling : {1, 2, 4}) {
        const Picture picture = draw_picture(*renderer, camera, size, flat, supersampling);
        ASSERT_EQ(picture.width, 80);
        ASSERT_EQ(picture.height, 60);
        ASSERT_EQ(picture.rgb.size(), 3U * 80 * 60);
        const auto green = [&](glm::dvec2 p) {
            return picture.rgb[3 * (static_cast<std::size_t>(p.y) * 80 + static_cast<std::size_t>(p.x)) + 1];
        };
        EXPECT_EQ(green(pixel), 255);
        EXPECT_EQ(green(pixel + glm::dvec2(8, 0)), 0);
        EXPECT_EQ(green({pixel.x, 59 - pixel.y}), 0);
    }
}

TEST_P(Pictures, may_be_as_large_as_promised) {
    renderer->set_points(0, 1);
    const Picture picture = draw_picture(*renderer, {}, {largest_picture, 2}, flat, 4);
    EXPECT_EQ(picture.rgb.size(), 6U * largest_picture);
}

INSTANTIATE_TEST_SUITE_P(Splats, Pictures, both_ways, name_of_way);

} // namespace
} // namespace knead::test

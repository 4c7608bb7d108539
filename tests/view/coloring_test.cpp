#include "view/coloring.h"

#include "base/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace knead::test {
namespace {

struct Colored {
    PointCloud cloud;
    std::vector<Index> file_index;
    std::vector<float> normals, values;
    Workers workers{2};

    explicit Colored(std::size_t n) {
        std::vector<float> positions(3 * n);
        for (std::size_t i = 0; i < n; ++i) positions[3 * i + 2] = 100.0f + static_cast<float>(i);
        cloud = make_cloud(positions);
        file_index.resize(n);
        std::iota(file_index.begin(), file_index.end(), Index{0});
    }

    Legend legend;
    std::vector<std::uint32_t> colors(const ColorBy& by) {
        std::vector<float> ordered;
        for (const Index i : file_index)
            for (std::size_t c = 0; c < 3; ++c) ordered.push_back(cloud.positions[3 * i + c]);
        std::vector<std::uint32_t> result(file_index.size());
        legend = color_points(by, {&cloud, file_index, ordered, normals, values}, result, workers);
        return result;
    }
};

std::uint32_t rgb(unsigned r, unsigned g, unsigned b) {
    return r | g << 8U | b << 16U | 0xff000000U;
}

std::uint32_t scale(double at) {
    const glm::vec3 color = viridis(at);
    const auto byte = [](float c) { return static_cast<unsigned>(std::lround(255 * c)); };
    return rgb(byte(color.r), byte(color.g), byte(color.b));
}

TEST(Coloring, takes_the_files_bytes_in_the_order_asked_for) {
    Colored it(3);
    add_attribute(it.cloud, "red", std::vector<std::uint8_t>{1, 2, 3});
    add_attribute(it.cloud, "green", std::vector<std::uint8_t>{10, 20, 30});
    add_attribute(it.cloud, "blue", std::vector<std::uint8_t>{100, 200, 255});
    it.file_index = {2, 0};
    EXPECT_EQ(own_colors(it.cloud), OwnColors::rgb);
    EXPECT_EQ(it.colors({}), (std::vector{rgb(3, 30, 255), rgb(1, 10, 100)}));
    EXPECT_TRUE(it.legend.title.empty());
}

TEST(Coloring, takes_colours_as_fractions_bytes_or_16_bits_in_floats) {
    for (const float brightest : {1.0f, 255.0f, 65535.0f}) {
        Colored it(2);
        for (const char* name : {"red", "green", "blue"})
            add_attribute(it.cloud, name, std::vector<float>{0, brightest});
        EXPECT_EQ(it.colors({}), (std::vector{rgb(0, 0, 0), rgb(255, 255, 255)})) << brightest;
    }
}

TEST(Coloring, white_for_all_is_no_colour) {
    Colored it(3);
    for (const char* name : {"red", "green", "blue"})
        add_attribute(it.cloud, name, std::vector<std::uint8_t>{255, 255, 255});
    const auto white = it.colors({});
    ColorBy plain;
    plain.kind = ColorBy::Kind::plain;
    EXPECT_EQ(white, it.colors(plain));
    Colored other(3);
    for (const char* name : {"red", "green", "blue"})
        add_attribute(other.cloud, name, std::vector<std::uint8_t>{255, 255, 254});
    EXPECT_NE(other.colors({}), white);
}

TEST(Coloring, shows_an_intensity_in_grey_where_there_are_no_colours) {
    Colored it(5);
    add_attribute(it.cloud, "Intensity", std::vector<float>{0, 200, 100, 4000, 150});
    EXPECT_EQ(own_colors(it.cloud), OwnColors::intensity);
    const auto greys = it.colors({});
    std::vector<unsigned> brightness;
    for (const std::uint32_t grey : greys) {
        brightness.push_back(grey & 0xffU);
        EXPECT_EQ(grey, rgb(brightness.back(), brightness.back(), brightness.back()));
    }
    EXPECT_LT(brightness[0], brightness[2]);
    EXPECT_LT(brightness[2], brightness[1]);
    EXPECT_LE(brightness[1], brightness[3]);
    EXPECT_NEAR(brightness[4], 0.5 * (brightness[0] + brightness[3]), 3); // of the middle one, by number
    EXPECT_GT(brightness[0], 30U); // neither black nor white, which light could not change
    EXPECT_LT(brightness[3], 250U);
    EXPECT_FALSE(it.legend.range);
    for (const char* name : {"red", "green", "blue"})
        add_attribute(it.cloud, name, std::vector<std::uint8_t>{1, 2, 3, 4, 5});
    EXPECT_EQ(it.colors({})[0], rgb(1, 1, 1));
}

TEST(Coloring, an_intensity_that_tells_nothing_is_about_as_bright_as_the_plain_colour) {
    Colored it(2);
    add_attribute(it.cloud, "intensity", std::vector<float>{7, 7});
    EXPECT_NEAR(it.colors({})[0] & 0xffU, 255 * ColorBy().plain.g, 1);
}

TEST(Coloring, an_intensity_without_a_number_is_dark_grey) {
    Colored it(2);
    add_attribute(it.cloud, "intensity", std::vector<float>(2, std::numeric_limits<float>::quiet_NaN()));
    const auto greys = it.colors({});
    EXPECT_EQ(greys[0], greys[1]);
    EXPECT_LT(greys[0] & 0xffU, 100U);
}

TEST(Coloring, falls_back_on_the_plain_colour) {
    Colored it(2);
    ColorBy by;
    by.plain = {1, 0, 0};
    EXPECT_EQ(own_colors(it.cloud), OwnColors::none);
    for (const auto kind : {ColorBy::Kind::own, ColorBy::Kind::plain, ColorBy::Kind::normal}) {
        by.kind = kind;
        EXPECT_EQ(it.colors(by), std::vector(2, rgb(255, 0, 0)));
        EXPECT_FALSE(it.legend.range);
    }
}

TEST(Coloring, tells_height_in_the_files_coordinates) {
    Colored it(201);
    ColorBy by;
    by.kind = ColorBy::Kind::height;
    const std::vector<std::uint32_t> colors = it.colors(by);
    EXPECT_EQ(it.legend.title, "Height");
    ASSERT_TRUE(it.legend.range);
    EXPECT_DOUBLE_EQ(it.legend.range->low, 102);
    EXPECT_DOUBLE_EQ(it.legend.range->high, 298);
    EXPECT_EQ(colors.front(), scale(0));
    EXPECT_EQ(colors.back(), scale(1));
    by.range = ValueRange{100, 300};
    EXPECT_EQ(it.colors(by)[100], scale(0.5));
    EXPECT_EQ(it.legend.range, by.range);
}

TEST(Coloring, tells_height_along_any_axis) {
    Colored it(3);
    it.cloud = make_cloud(std::vector<float>{0, 1, 5, 0, 2, 4, 0, 3, 6});
    ColorBy by;
    by.kind = ColorBy::Kind::height;
    by.up = UpAxis::y;
    by.range = ValueRange{1, 3};
    EXPECT_EQ(it.colors(by), (std::vector<std::uint32_t>{scale(0), scale(0.5), scale(1)}));
    by.up = UpAxis::minus_y;
    by.range = ValueRange{-3, -1};
    EXPECT_EQ(it.colors(by), (std::vector<std::uint32_t>{scale(1), scale(0.5), scale(0)}));
}

TEST(Coloring, shows_normals_as_colours) {
    Colored it(1);
    it.normals = {1, 0, -1};
    ColorBy by;
    by.kind = ColorBy::Kind::normal;
    EXPECT_EQ(it.colors(by)[0], rgb(255, 128, 0));
}

TEST(Coloring, tells_a_column_and_refuses_what_is_none) {
    Colored it(3);
    add_attribute(it.cloud, "heat", std::vector<float>{1, 2, 3});
    EXPECT_EQ(scalar_columns(it.cloud), std::vector<std::string>{"heat"});
    ColorBy by;
    by.kind = ColorBy::Kind::attribute;
    by.attribute = "heat";
    by.range = ValueRange{1, 3};
    EXPECT_EQ(it.colors(by), (std::vector{scale(0), scale(0.5), scale(1)}));
    EXPECT_EQ(it.legend.title, "heat");
    by.attribute = "cold";
    try {
        it.colors(by);
        FAIL() << "no error";
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::usage);
        EXPECT_NE(std::string(error.what()).find("heat"), std::string::npos) << error.what();
    }
}

TEST(Coloring, stays_sane_with_values_that_are_equal_or_not_finite) {
    Colored it(3);
    ColorBy by;
    by.kind = ColorBy::Kind::values;
    by.title = "stretch";
    it.values = {7, 7, 7};
    EXPECT_EQ(it.colors(by), std::vector(3, scale(0.5)));
    EXPECT_EQ(it.legend.title, "stretch");
    it.values = {NAN, INFINITY, 7};
    const std::vector<std::uint32_t> colors = it.colors(by);
    EXPECT_EQ(colors[0], colors[1]);
    EXPECT_EQ(colors[2], scale(0.5));
    it.values = {NAN, NAN, NAN};
    EXPECT_EQ(it.colors(by), std::vector(3, colors[0]));
}

TEST(Coloring, of_no_points_is_nothing) {
    Colored it(0);
    for (const auto kind : {ColorBy::Kind::own, ColorBy::Kind::height, ColorBy::Kind::values}) {
        ColorBy by;
        by.kind = kind;
        EXPECT_TRUE(it.colors(by).empty());
    }
}

TEST(Coloring, viridis_runs_from_violet_to_yellow_and_gets_lighter_all_the_way) {
    const auto lightness = [](const glm::vec3& c) { return 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b; };
    for (int i = 1; i <= 100; ++i)
        EXPECT_GT(lightness(viridis(i / 100.0)), lightness(viridis((i - 1) / 100.0))) << i;
    EXPECT_EQ(viridis(-1), viridis(0));
    EXPECT_EQ(viridis(2), viridis(1));
}

} // namespace
} // namespace knead::test

// Which columns are colours, and what full brightness is in them.

#include "cloud/colors.h"

#include <gtest/gtest.h>

#include <limits>

namespace knead::test {
namespace {

using Columns = std::array<std::size_t, 3>;

// One point.
PointCloud with(std::initializer_list<const char*> names, ScalarType type, double value) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0});
    for (const char* const name : names) {
        if (type == ScalarType::uint8)
            add_attribute(cloud, name, std::vector{static_cast<std::uint8_t>(value)});
        else
            add_attribute(cloud, name, std::vector{static_cast<float>(value)});
    }
    return cloud;
}

PointCloud with_shorts(std::uint16_t red, std::uint16_t green, std::uint16_t blue) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0});
    const auto add = [&](const char* name, std::uint16_t value) {
        const auto bytes = std::as_bytes(std::span(&value, 1));
        cloud.attributes.push_back(
            {name, ScalarType::uint16, {bytes.begin(), bytes.end()}, {}, ScalarType::uint8});
    };
    add("red", red);
    add("green", green);
    add("blue", blue);
    return cloud;
}

double brightest(const PointCloud& cloud) {
    return brightest_value(cloud, find_colors(cloud).value());
}

TEST(Colors, AreFoundByAnyOfTheirNames) {
    EXPECT_EQ(find_colors(with({"blue", "red", "green"}, ScalarType::uint8, 1)), (Columns{4, 5, 3}));
    EXPECT_EQ(find_colors(with({"diffuse_red", "diffuse_green", "diffuse_blue"}, ScalarType::uint8, 1)),
              (Columns{3, 4, 5}));
    EXPECT_EQ(find_colors(with({"r", "g", "b"}, ScalarType::float32, 1)), (Columns{3, 4, 5}));
}

TEST(Colors, AreThreeColumnsOfOneSpelling) {
    EXPECT_FALSE(find_colors(with({"red", "green"}, ScalarType::uint8, 1)));
    EXPECT_FALSE(find_colors(with({"red", "g", "b"}, ScalarType::uint8, 1)));
    EXPECT_FALSE(find_colors(with({"Red", "Green", "Blue"}, ScalarType::uint8, 1)));
}

TEST(Colors, ByTheirFullNamesComeFirst) {
    EXPECT_EQ(find_colors(with({"r", "g", "b", "red", "green", "blue"}, ScalarType::uint8, 1)),
              (Columns{6, 7, 8}));
    EXPECT_EQ(find_colors(with({"r", "g", "b", "red", "green"}, ScalarType::uint8, 1)), (Columns{3, 4, 5}));
}

TEST(Colors, AreNoLists) {
    PointCloud cloud = with({"red", "green", "blue"}, ScalarType::uint8, 1);
    cloud.attributes[4].first = {0, 1};
    EXPECT_FALSE(find_colors(cloud));
}

TEST(Colors, OfBytesAreFullAt255) {
    EXPECT_EQ(brightest(with({"red", "green", "blue"}, ScalarType::uint8, 1)), 255);
}

TEST(Colors, OfFloatsAreFractionsUnlessOneIsAbove1) {
    EXPECT_EQ(brightest(with({"red", "green", "blue"}, ScalarType::float32, 0.25)), 1);
    EXPECT_EQ(brightest(with({"red", "green", "blue"}, ScalarType::float32, 1)), 1);
    EXPECT_EQ(brightest(with({"red", "green", "blue"}, ScalarType::float32, 1.5)), 255);
    EXPECT_EQ(brightest(with({"red", "green", "blue"}, ScalarType::float32, 256)), 65535);
}

TEST(Colors, WhatIsNoNumberIsNotTheBrightest) {
    PointCloud cloud = with({"red", "green"}, ScalarType::float32, 0.5);
    add_attribute(cloud, "blue", std::vector{std::numeric_limits<float>::infinity()});
    EXPECT_EQ(brightest(cloud), 1);
}

TEST(Colors, Of16BitsHoldBytesInSomeFiles) {
    EXPECT_EQ(brightest(with_shorts(255, 0, 12)), 255);
    EXPECT_EQ(brightest(with_shorts(0, 256, 0)), 65535);
    EXPECT_EQ(brightest(with_shorts(1, 1, 1)), 255) << "not fractions";
}

} // namespace
} // namespace knead::test

#include "io/compare.h"
#include "io/ply_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace knead::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();

TEST(Compare, of_a_cloud_with_itself_is_zero) {
    const PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3, nan, 5, 6, 7, 8, 9});
    const Distances distances = distances_between(cloud, cloud);
    EXPECT_EQ(distances.largest, 0);
    EXPECT_EQ(distances.rms, 0);
    EXPECT_EQ(distances.compared, 3U);
    EXPECT_EQ(distances.incomparable, 0U);
    EXPECT_TRUE(attribute_differences(cloud, cloud).none());
}

TEST(Compare, measures_in_the_files_coordinates) {
    std::vector<float> positions(3 * 100, 5.0F);
    const PointCloud a = make_cloud(positions);
    positions[3 * 17] += 3;
    positions[3 * 17 + 1] += 4;
    for (std::size_t i = 90; i < 94; ++i) positions[3 * i + 2] += 1;
    const PointCloud b = make_cloud(positions);
    const Distances distances = distances_between(a, b);
    EXPECT_EQ(distances.largest, 5);
    EXPECT_EQ(distances.largest_index, 17U);
    EXPECT_EQ(distances.p95, 0) << "95 points of 100 are at distance 0";
    EXPECT_DOUBLE_EQ(distances.rms, std::sqrt(29.0 / 100));
    positions[3 * 94] += 2;
    EXPECT_EQ(distances_between(a, make_cloud(positions)).p95, 1);
}

TEST(Compare, counts_points_that_are_finite_in_one_cloud_only) {
    const PointCloud a = make_cloud(std::vector<float>{1, 2, 3, nan, 5, 6, nan, 1, 1});
    const PointCloud b = make_cloud(std::vector<float>{nan, 2, 3, nan, 5, 6, nan, 2, 1});
    const Distances distances = distances_between(a, b);
    EXPECT_EQ(distances.incomparable, 1U);
    EXPECT_EQ(distances.first_incomparable, 0U);
    EXPECT_EQ(distances.compared, 2U);
    EXPECT_EQ(distances.largest, 1) << "the one that lacks x in both";
    EXPECT_EQ(distances.largest_index, 2U);
}

TEST(Compare, of_no_points_is_zero) {
    const PointCloud cloud = make_cloud({});
    EXPECT_EQ(distances_between(cloud, cloud).compared, 0U);
}

TEST(Compare, of_a_pose_agrees_with_its_saved_file) {
    const PointCloud cloud = read_bytes(sample({}));
    std::vector<float> posed = cloud.positions;
    posed[4] += 2.5F;
    const PointCloud saved = read_bytes(written(cloud, {posed, {}}));
    EXPECT_EQ(distances_between(cloud, posed, saved).largest, 0);
    EXPECT_EQ(distances_between(cloud, cloud.positions, saved).largest, 2.5);
    EXPECT_EQ(distances_between(cloud, cloud.positions, saved).largest_index, 1U);
}

std::vector<std::string> names_of(const std::vector<AttributeDifference>& differences) {
    std::vector<std::string> names;
    for (const AttributeDifference& each : differences) names.push_back(each.name);
    return names;
}

PointCloud two_points(const std::string& type, const std::string& x, const std::string& other_x) {
    return read_bytes("ply\nformat ascii 1.0\nelement vertex 2\nproperty " + type + " x\nproperty " + type +
                      " y\nproperty " + type + " z\nend_header\n" + x + " 0 0\n" + other_x + " 0 0\n");
}

// A recorded check must hold for the shape that it was recorded of, however its file rounds.
TEST(Compare, does_not_count_what_rounding_to_the_files_types_explains) {
    struct Case {
        const char *type, *x, *other;
        double half;
    };
    for (const auto& [type, x, other, half] :
         {Case{"int", "0", "10", 0.5}, Case{"float", "4000000", "4000010", 0.125}}) {
        const PointCloud saved = two_points(type, x, other);
        const PointCloud cloud = two_points("double", x, other);
        const auto moved_by = [&](double by) {
            std::vector<float> posed = cloud.positions;
            posed[3] += static_cast<float>(by);
            return distances_between(cloud, posed, saved).largest;
        };
        EXPECT_EQ(moved_by(0.9 * half), 0) << type;
        EXPECT_NEAR(moved_by(1.5 * half), 1.5 * half, 1e-3 * half) << type;
    }
}

TEST(Compare, names_attributes_that_differ) {
    const std::vector<float> point{1, 2, 3};
    const std::vector<float> value{4};
    PointCloud a = make_cloud(point);
    PointCloud b = make_cloud(point);
    add_attribute(a, "same", value);
    add_attribute(b, "other", value);
    add_attribute(b, "same", value);
    add_attribute(a, "type", std::vector<float>{1});
    add_attribute(b, "type", std::vector<std::uint8_t>{1});
    add_attribute(a, "value", std::vector<std::uint8_t>{1});
    add_attribute(b, "value", std::vector<std::uint8_t>{2});
    add_attribute(a, "mine", value);
    const AttributeDifferences differences = attribute_differences(a, b);
    EXPECT_EQ(names_of(differences.differ), (std::vector<std::string>{"type", "value"}));
    EXPECT_EQ(differences.only_in_a, std::vector<std::string>{"mine"});
    EXPECT_EQ(differences.only_in_b, std::vector<std::string>{"other"});
}

TEST(Compare, tells_by_how_much_attributes_differ) {
    const float no_number = std::numeric_limits<float>::quiet_NaN();
    PointCloud a = make_cloud(std::vector<float>(12, 0));
    PointCloud b = a;
    add_attribute(a, "heat", std::vector<float>{1, 2, no_number, 0});
    add_attribute(b, "heat", std::vector<float>{1, 2.5F, 1, -0.0F}); // and 0 is not -0 in the file
    add_attribute(a, "class", std::vector<std::uint8_t>{1, 2, 3, 4});
    add_attribute(b, "class", std::vector<float>{1, 2, 3, 4});
    const auto differ = attribute_differences(a, b).differ;
    ASSERT_EQ(names_of(differ), (std::vector<std::string>{"heat", "class"}));
    EXPECT_TRUE(differ[0].same_type);
    EXPECT_EQ(differ[0].points, 3U);
    EXPECT_EQ(differ[0].largest, 0.5);
    EXPECT_EQ(differ[0].farthest_point, 1U);
    EXPECT_FALSE(differ[1].same_type);
    EXPECT_EQ(differ[1].points, 0U);
}

TEST(Compare, tells_by_how_much_lists_differ) {
    const auto with_lists = [](std::vector<std::uint64_t> first, std::vector<std::uint8_t> values) {
        PointCloud cloud = make_cloud(std::vector<float>(9, 0));
        add_attribute(cloud, "list", values);
        cloud.attributes.back().first = std::move(first);
        return cloud;
    };
    const PointCloud a = with_lists({0, 2, 2, 3}, {1, 2, 9});
    const PointCloud b = with_lists({0, 2, 3, 4}, {1, 6, 0, 8});
    const auto differ = attribute_differences(a, b).differ;
    ASSERT_EQ(names_of(differ), std::vector<std::string>{"list"});
    EXPECT_EQ(differ[0].points, 3U); // another item, another length, another item
    EXPECT_EQ(differ[0].largest, 4);
    EXPECT_EQ(differ[0].farthest_point, 0U);
    EXPECT_TRUE(attribute_differences(a, a).none());
}

TEST(Compare, takes_a_hundred_thousand_columns) {
    PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3});
    for (int i = 0; i < 100'000; ++i)
        add_attribute(cloud, "c" + std::to_string(i), std::vector<std::uint8_t>{1});
    PointCloud other = cloud;
    other.attributes[50'000].values[0] = std::byte{2};
    other.attributes[7].name = "d";
    const AttributeDifferences differences = attribute_differences(cloud, other);
    EXPECT_EQ(names_of(differences.differ), std::vector<std::string>{"c49997"});
    EXPECT_EQ(differences.only_in_a, std::vector<std::string>{"c4"});
    EXPECT_EQ(differences.only_in_b, std::vector<std::string>{"d"});
}

} // namespace
} // namespace knead::test

#include "base/require.h"
#include "cloud/point_cloud.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace knead::test {
namespace {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float infinity = std::numeric_limits<float>::infinity();

template<typename T>
Attribute column_of(const char* name, ScalarType type, const std::vector<T>& values) {
    const auto bytes = std::as_bytes(std::span(values));
    return {name, type, {bytes.begin(), bytes.end()}, {}, ScalarType::uint8};
}

template<typename T>
PointCloud cloud_of(ScalarType type, const std::vector<T>& x, const std::vector<T>& y,
                    const std::vector<T>& z) {
    PointCloud cloud;
    cloud.attributes = {column_of("x", type, x), column_of("y", type, y), column_of("z", type, z)};
    cloud.coordinate_columns = {0, 1, 2};
    set_positions_from_columns(cloud);
    return cloud;
}

template<typename T>
void expect_extremes(ScalarType type) {
    const T lowest = std::numeric_limits<T>::lowest();
    const T highest = std::numeric_limits<T>::max();
    const Attribute column = column_of<T>("a", type, {lowest, highest, T{3}});
    EXPECT_EQ(value_at(column, 0), static_cast<double>(lowest));
    EXPECT_EQ(value_at(column, 1), static_cast<double>(highest));
    EXPECT_EQ(value_at(column, 2), 3.0);
    EXPECT_EQ(size_of(type), sizeof(T));
    const PointCloud cloud = cloud_of<T>(type, {T{1}, T{3}}, {T{1}, T{5}}, {T{2}, T{2}});
    EXPECT_EQ(cloud.origin, Vec3d(2, 3, 2)) << name_of(type);
    EXPECT_EQ(cloud.position(1), Vec3f(1, 2, 0)) << name_of(type);
}

TEST(PointCloud, holds_every_type_exactly) {
    expect_extremes<std::int8_t>(ScalarType::int8);
    expect_extremes<std::uint8_t>(ScalarType::uint8);
    expect_extremes<std::int16_t>(ScalarType::int16);
    expect_extremes<std::uint16_t>(ScalarType::uint16);
    expect_extremes<std::int32_t>(ScalarType::int32);
    expect_extremes<std::uint32_t>(ScalarType::uint32);
    expect_extremes<std::int64_t>(ScalarType::int64);
    expect_extremes<std::uint64_t>(ScalarType::uint64);
    expect_extremes<float>(ScalarType::float32);
    expect_extremes<double>(ScalarType::float64);
}

TEST(PointCloud, has_its_origin_in_the_middle_of_the_finite_points) {
    const PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3, 3, 6, 3, nan, 0, 0, 0, infinity, 0});
    EXPECT_EQ(cloud.origin, Vec3d(2, 4, 3));
    EXPECT_EQ(cloud.position(0), Vec3f(-1, -2, 0));
    EXPECT_EQ(cloud.file_position(1), Vec3d(3, 6, 3));
    EXPECT_TRUE(is_finite(cloud, 1));
    EXPECT_FALSE(is_finite(cloud, 2));
    EXPECT_FALSE(is_finite(cloud, 3));
}

TEST(PointCloud, keeps_what_far_coordinates_in_double_tell_apart) {
    const PointCloud cloud =
        cloud_of<double>(ScalarType::float64, {5403123.125, 5403123.126}, {0, 0}, {0, 0});
    EXPECT_NEAR(static_cast<double>(cloud.position(1)[0] - cloud.position(0)[0]), 0.001, 1e-9);
}

// One absurd coordinate must not push all other points out of reach.
TEST(PointCloud, leaves_out_what_no_float_can_hold) {
    const PointCloud cloud = cloud_of<double>(ScalarType::float64, {1, 3, 1e300}, {0, 0, 0}, {0, 0, 0});
    EXPECT_EQ(cloud.origin, Vec3d(2, 0, 0));
    EXPECT_TRUE(is_finite(cloud, 0));
    EXPECT_FALSE(is_finite(cloud, 2));
    EXPECT_EQ(bounds_of(cloud).finite_points, 2U);
    EXPECT_EQ(bounds_of(cloud).diagonal(), 2);
}

TEST(PointCloud, has_bounds_in_the_files_coordinates) {
    std::vector<float> positions;
    for (int i = 0; i < 5000; ++i) positions.insert(positions.end(), {static_cast<float>(i), -1, 4});
    positions[7] = nan;
    const Bounds bounds = bounds_of(make_cloud(positions));
    EXPECT_EQ(bounds.lowest, Vec3d(0, -1, 4));
    EXPECT_EQ(bounds.highest, Vec3d(4999, -1, 4));
    EXPECT_EQ(bounds.finite_points, 4999U);
    EXPECT_EQ(bounds.diagonal(), 4999);
}

TEST(PointCloud, may_have_no_point_or_none_that_is_finite) {
    for (const auto& positions : {std::vector<float>{}, std::vector<float>{nan, 1, 2}}) {
        const PointCloud cloud = make_cloud(positions);
        EXPECT_EQ(cloud.origin, Vec3d(0, 0, 0));
        EXPECT_EQ(bounds_of(cloud).finite_points, 0U);
        EXPECT_EQ(bounds_of(cloud).diagonal(), 0);
    }
}

TEST(PointCloud, finds_normals_by_any_spelling) {
    for (const auto& names : {std::array{"nx", "ny", "nz"}, std::array{"normal_x", "normal_y", "normal_z"},
                              std::array{"NormalX", "NormalY", "NormalZ"}, std::array{"Nx", "Ny", "Nz"}}) {
        PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 1, 1});
        EXPECT_FALSE(find_normals(cloud));
        EXPECT_TRUE(read_normals(cloud).empty());
        add_attribute(cloud, names[2], std::vector<float>{3, 6});
        add_attribute(cloud, names[0], std::vector<float>{1, 4});
        EXPECT_FALSE(find_normals(cloud)) << "two of three are no normal";
        add_attribute(cloud, names[1], std::vector<float>{2, 5});
        EXPECT_EQ(find_normals(cloud), (std::array<std::size_t, 3>{4, 5, 3}));
        EXPECT_EQ(read_normals(cloud), (std::vector<float>{1, 2, 3, 4, 5, 6}));
    }
}

TEST(PointCloud, takes_whole_numbers_for_normals_if_they_have_a_sign) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0});
    for (const char* name : {"nx", "ny", "nz"}) add_attribute(cloud, name, std::vector<std::uint8_t>{0xFF});
    EXPECT_FALSE(find_normals(cloud));
    EXPECT_EQ(find_normal_names(cloud), (std::array<std::size_t, 3>{3, 4, 5}));
    for (Attribute& attribute : cloud.attributes)
        if (attribute.type == ScalarType::uint8) attribute.type = ScalarType::int8;
    EXPECT_EQ(read_normals(cloud), (std::vector<float>{-1, -1, -1}));
    cloud.attributes.back() = {"nz", ScalarType::int16, std::vector<std::byte>(2), {}, ScalarType::uint8};
    EXPECT_FALSE(find_normals(cloud)) << "of what unit?";
    EXPECT_TRUE(find_normal_names(cloud));
}

TEST(PointCloud, takes_other_columns_for_normals_where_the_first_ones_point_nowhere) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0});
    for (const char* name : {"nx", "ny", "nz"}) add_attribute(cloud, name, std::vector<std::uint8_t>{9});
    for (const char* name : {"Nx", "Ny", "Nz"}) add_attribute(cloud, name, std::vector<float>{1});
    EXPECT_EQ(find_normals(cloud), (std::array<std::size_t, 3>{6, 7, 8}));
}

TEST(PointCloud, refuses_columns_that_are_not_equally_long) {
    EXPECT_THROW(cloud_of<float>(ScalarType::float32, {1, 2}, {1}, {1, 2}), BrokenInvariant);
    EXPECT_THROW(make_cloud(std::vector<float>{1, 2}), BrokenInvariant);
}

TEST(PointCloud, tells_names_apart_by_case) {
    const PointCloud cloud = make_cloud(std::vector<float>{1, 2, 3});
    EXPECT_EQ(find_attribute(cloud, "y"), 1U);
    EXPECT_FALSE(find_attribute(cloud, "Y"));
}

} // namespace
} // namespace knead::test

#include "io/las_header.h"
#include "io/las_samples.h"
#include "io/scalar_bytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <iomanip>
#include <limits>
#include <sstream>

namespace knead::test {
namespace {

std::vector<float> moved(const PointCloud& cloud, std::size_t point, const Vec3f& by) {
    std::vector<float> positions = cloud.positions;
    for (std::size_t axis = 0; axis < 3; ++axis) positions[3 * point + axis] += by[static_cast<int>(axis)];
    return positions;
}

double value_of(const PointCloud& cloud, std::string_view name, std::size_t point) {
    const auto column = find_attribute(cloud, name);
    return column ? value_at(cloud.attributes[*column], point) : std::nan("");
}

TEST(LasWriter, leaves_every_byte_of_an_unmoved_cloud) {
    for (const LasKind& kind : all_las_kinds()) {
        const std::string bytes = las_sample(kind);
        const PointCloud cloud = read_bytes(bytes);
        std::vector<std::string> heard;
        EXPECT_EQ(written(cloud, {}, "out.las", &heard), bytes) << name_of(kind);
        EXPECT_EQ(written(cloud, {cloud.positions, read_normals(cloud)}, "out.las"), bytes) << name_of(kind);
        EXPECT_TRUE(heard.empty());
    }
}

TEST(LasWriter, changes_the_numbers_of_moved_points_and_the_bounds_of_their_axes_only) {
    for (const LasKind& kind : all_las_kinds()) {
        SCOPED_TRACE(name_of(kind));
        std::string expected = las_sample(kind);
        const PointCloud cloud = read_bytes(expected);
        std::vector<std::string> heard;
        const std::string saved = written(cloud, {moved(cloud, 2, {1.25F, 0, -0.5F}), {}}, "out.las", &heard);
        EXPECT_TRUE(heard.empty());
        const std::size_t row = las_points_begin(kind) + 2 * las_length(kind);
        put(expected, row, std::int32_t{114 + 125});
        put(expected, row + 8, std::int32_t{12 - 50});
        put(expected, 179, 239 * 0.01); // highest x
        put(expected, 187, 100 * 0.01); // lowest x; y keeps its bounds
        put(expected, 211, 48 * 0.01);  // highest z
        put(expected, 219, -38 * 0.01); // lowest z
        EXPECT_EQ(saved, expected);
    }
}

TEST(LasWriter, rounds_to_the_nearest_step_of_the_files_own_scale) {
    LasKind kind;
    kind.scale = {0.25, 0.25, 0.25};
    kind.offset = {400000, 5000000, 0};
    const PointCloud cloud = read_bytes(las_sample(kind));
    const PointCloud back =
        read_bytes(written(cloud, {moved(cloud, 1, {0.3F, 0.12F, 0.13F}), {}}, "out.las"));
    EXPECT_EQ(back.file_position(1), cloud.file_position(1) + Vec3d(0.25, 0, 0.25));
    EXPECT_EQ(back.file_position(0), cloud.file_position(0));
}

TEST(LasWriter, keeps_bounds_in_order_where_a_scale_is_negative) {
    LasKind kind;
    kind.scale = {0.01, 0.01, -0.01};
    const PointCloud cloud = read_bytes(las_sample(kind));
    const std::string saved = written(cloud, {moved(cloud, 2, {0, 0, -0.5F}), {}}, "out.las");
    EXPECT_NEAR(get<double>(saved, 211), 0, 1e-9); // the number 0, of point 0
    EXPECT_NEAR(get<double>(saved, 219), -0.62, 1e-9);
    EXPECT_NEAR(read_bytes(saved).file_position(2).z(), -0.62, 1e-9);
}

TEST(LasWriter, takes_a_new_offset_only_where_the_pose_leaves_the_range_and_says_so) {
    LasKind kind;
    kind.minor = 4;
    kind.format = 6;
    kind.scale = {1e-7, 1e-7, 1e-7};
    kind.offset = {400000, 0, 0};
    const std::string bytes = las_sample(kind);
    const PointCloud cloud = read_bytes(bytes);
    std::vector<std::string> heard;
    const std::vector<float> posed = moved(cloud, 3, {300, 0, 0});
    const std::string saved = written(cloud, {posed, {}}, "out.las", &heard);
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_NE(heard[0].find("along x"), std::string::npos) << heard[0];
    EXPECT_EQ(heard[0].find("scale"), std::string::npos) << heard[0];
    const PointCloud back = read_bytes(saved);
    EXPECT_EQ(get<double>(saved, 131), 1e-7);
    EXPECT_NE(get<double>(saved, 155), 400000.0);
    EXPECT_EQ(saved.substr(139, 16), bytes.substr(139, 16)); // the scales of y and z
    EXPECT_EQ(saved.substr(163, 16), bytes.substr(163, 16)); // and their offsets
    const double far = static_cast<double>(posed[9]) - static_cast<double>(cloud.positions[9]);
    EXPECT_NEAR(back.file_position(3).x(), cloud.file_position(3).x() + far, 0.51e-7);
    for (const std::size_t i : {0, 1, 2, 4})
        EXPECT_NEAR(back.file_position(i).x(), cloud.file_position(i).x(), 1e-10);
    EXPECT_NEAR(get<double>(saved, 179), 400300, 1e-4);
    EXPECT_NEAR(get<double>(saved, 187), 400000, 1e-4);
}

TEST(LasWriter, takes_coarser_steps_where_the_extent_asks_for_them) {
    LasKind kind;
    kind.scale = {1e-7, 1e-7, 1e-7};
    const PointCloud cloud = read_bytes(las_sample(kind));
    std::vector<std::string> heard;
    const std::string saved = written(cloud, {moved(cloud, 3, {0, -2000, 0}), {}}, "out.las", &heard);
    ASSERT_EQ(heard.size(), 1U);
    EXPECT_NE(heard[0].find("scale 1e-06"), std::string::npos) << heard[0];
    const PointCloud back = read_bytes(saved);
    EXPECT_NEAR(back.file_position(3).y(), -2000, 1e-4);
    EXPECT_NEAR(back.file_position(0).y(), cloud.file_position(0).y(), 0.6e-6);
    EXPECT_NE(refusal_to_write(cloud, {moved(cloud, 3, {std::nanf(""), 0, 0}), {}}, "out.las"), "");
}

TEST(LasWriter, has_the_bounds_of_the_points_in_coarser_steps_too) {
    LasKind kind;
    kind.scale = {1e-7, 1e-7, 1e-7};
    const PointCloud cloud = read_bytes(las_sample(kind));
    for (int i = 0; i < 60; ++i) {
        const float far = 1200 + 7.31F * static_cast<float>(i);
        const std::string saved = written(cloud, {moved(cloud, 3, {far, 0, 0}), {}}, "out.las");
        const PointCloud back = read_bytes(saved);
        double lowest = back.file_position(0).x(), highest = lowest;
        for (std::size_t p = 1; p < back.size(); ++p) {
            lowest = std::min(lowest, back.file_position(p).x());
            highest = std::max(highest, back.file_position(p).x());
        }
        EXPECT_EQ(get<double>(saved, 179), highest) << far;
        EXPECT_EQ(get<double>(saved, 187), lowest) << far;
    }
}

TEST(LasWriter, turns_normals_that_are_floats) {
    LasKind kind;
    kind.extra = {{"NormalX", 9}, {"NormalY", 10}, {"NormalZ", 9}};
    const PointCloud cloud = read_bytes(las_sample(kind));
    std::vector<float> normals = read_normals(cloud);
    ASSERT_EQ(normals.size(), 15U);
    normals[3] = 0.5F;
    normals[4] = -0.25F;
    const std::string saved = written(cloud, {cloud.positions, normals}, "out.las");
    const PointCloud back = read_bytes(saved);
    EXPECT_EQ(read_normals(back), normals);
    EXPECT_EQ(back.positions, cloud.positions);
    std::string expected = las_sample(kind);
    put(expected, las_points_begin(kind) + las_length(kind) + 20, 0.5F);
    put(expected, las_points_begin(kind) + las_length(kind) + 24, -0.25);
    EXPECT_EQ(saved, expected);
}

TEST(LasWriter, turns_normals_that_are_scaled_whole_numbers) {
    LasKind kind;
    for (const char* name : {"nx", "ny", "nz"}) kind.extra.push_back({name, 4, 0.125, 0});
    std::string expected = las_sample(kind);
    const PointCloud cloud = read_bytes(expected);
    std::vector<float> normals = read_normals(cloud);
    ASSERT_EQ(normals.size(), 15U);
    EXPECT_EQ(normals[3], 0.125F);
    normals[3] = 0.5F;
    normals[5] = -0.3F; // between two steps
    put(expected, las_points_begin(kind) + las_length(kind) + 20, std::int16_t{4});
    put(expected, las_points_begin(kind) + las_length(kind) + 24, std::int16_t{-2});
    EXPECT_EQ(written(cloud, {cloud.positions, normals}, "out.las"), expected);
}

TEST(LasWriter, adds_columns_to_every_kind_of_file) {
    const std::vector<float> far{0, 0.5F, 1, -2, 1e-20F};
    for (const LasKind& kind : all_las_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const std::string bytes = las_sample(kind);
        const PointCloud cloud = read_bytes(bytes);
        const std::string saved = written(cloud, {{}, {}, {{"far", far}, {"intensity", far}}}, "out.las");
        const PointCloud back = read_bytes(saved);
        ASSERT_EQ(back.attributes.size(), cloud.attributes.size() + 2);
        for (std::size_t a = 0; a < cloud.attributes.size(); ++a) {
            EXPECT_EQ(back.attributes[a].name, cloud.attributes[a].name);
            EXPECT_EQ(back.attributes[a].values, cloud.attributes[a].values);
        }
        for (const char* name : {"far", "intensity_2"})
            for (std::size_t i = 0; i < far.size(); ++i)
                EXPECT_EQ(value_of(back, name, i), static_cast<double>(far[i]));
        // Records behind the points are found where they now are.
        const std::size_t behind = kind.extended > 0 ? 131 : 0;
        EXPECT_EQ(saved.substr(saved.size() - behind), bytes.substr(bytes.size() - behind));
    }
}

TEST(LasWriter, moves_the_places_of_what_lies_behind_the_points) {
    constexpr std::size_t waveforms = 227, extended = 235; // in the header
    const std::vector<float> far(5, 1);
    for (const unsigned minor : {3U, 4U})
        for (const bool has_any : {false, true}) {
            LasKind kind;
            kind.minor = minor;
            kind.extended = has_any && minor == 4 ? 2 : 0;
            std::string bytes = las_sample(kind);
            if (has_any) {
                put(bytes, waveforms, std::uint64_t{bytes.size()});
                bytes += "waveforms";
            }
            const std::string saved = written(read_bytes(bytes), {{}, {}, {{"far", far}}}, "out.las");
            const std::uint64_t grown = has_any ? saved.size() - bytes.size() : 0; // a place of 0 is none
            EXPECT_EQ(get<std::uint64_t>(saved, waveforms), get<std::uint64_t>(bytes, waveforms) + grown);
            if (minor == 4) {
                EXPECT_EQ(get<std::uint64_t>(saved, extended), get<std::uint64_t>(bytes, extended) + grown);
            }
        }
}

TEST(LasWriter, adds_columns_where_a_description_ends_in_half_an_entry) {
    LasKind kind;
    kind.extra = {{"serial", 7}};
    std::string bytes = las_sample(kind);
    bytes.insert(las_points_begin(kind), 7, 'h');
    put(bytes, 227 + 20, std::uint16_t{192 + 7});
    put(bytes, 96, static_cast<std::uint32_t>(las_points_begin(kind) + 7));
    const std::vector<float> far{0, 0.5F, 1, -2, 3};
    const PointCloud back = read_bytes(written(read_bytes(bytes), {{}, {}, {{"far", far}}}, "out.las"));
    for (std::size_t i = 0; i < far.size(); ++i) {
        EXPECT_EQ(value_of(back, "serial", i), static_cast<double>(i));
        EXPECT_EQ(value_of(back, "far", i), static_cast<double>(far[i]));
    }
}

// --- New files ---------------------------------------------------------------------------------------------

const std::string ply_header = "ply\nformat ascii 1.0\nelement vertex 3\n";
const std::string ply_double_xyz = "property double x\nproperty double y\nproperty double z\n";

// Fractions that are all 0 or 1 are whole numbers, too.
TEST(LasWriter, fills_its_colours_from_floats) {
    const std::string header = ply_header + ply_double_xyz +
                               "property float red\nproperty float green\nproperty float blue\nend_header\n";
    const PointCloud pure = read_bytes(header + "1 2 3 1 0 1\n1 2 4 1 1 1\n1 2 5 0 0 1\n");
    const PointCloud bytes = read_bytes(header + "1 2 3 255 0 7\n1 2 4 1 0 0\n1 2 5 0 0 1\n");
    const PointCloud pure_back = read_bytes(written(pure, {}, "out.las"));
    const PointCloud bytes_back = read_bytes(written(bytes, {}, "out.las"));
    for (const char* const name : {"red", "green", "blue"})
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(value_of(pure_back, name, i), 65535 * value_of(pure, name, i));
            EXPECT_EQ(value_of(bytes_back, name, i), 256 * value_of(bytes, name, i));
        }
}

TEST(LasWriter, makes_a_new_file_of_another_formats_cloud) {
    const PointCloud cloud = read_bytes(ply_header + ply_double_xyz +
                                        "property uchar red\nproperty uchar green\nproperty uchar blue\n"
                                        "property ushort Intensity\nproperty double gps_time\nend_header\n"
                                        "431234.125 5403123.5 100 255 0 7 65535 1.5\n"
                                        "431235.25 5403124.5 101 254 1 8 0 2.5\n"
                                        "431299.0 5403199.123456 99 253 2 9 5 3.5\n");
    std::vector<std::string> heard;
    const std::string saved = written(cloud, {}, "out.las", &heard);
    EXPECT_NE(joined(heard).find("steps of 1e-07"), std::string::npos) << joined(heard);
    const PointCloud back = read_bytes(saved);
    EXPECT_EQ(file_kind(back).encoding, "1.2, point format 3");
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_LE((back.file_position(i) - cloud.file_position(i)).cwiseAbs().maxCoeff(), 0.51e-7);
        EXPECT_EQ(value_of(back, "red", i), 256 * value_of(cloud, "red", i));
        EXPECT_EQ(value_of(back, "blue", i), 256 * value_of(cloud, "blue", i));
        EXPECT_EQ(value_of(back, "intensity", i), value_of(cloud, "Intensity", i));
        EXPECT_EQ(value_of(back, "gps_time", i), value_of(cloud, "gps_time", i));
        EXPECT_EQ(value_of(back, "return_number", i), 1);
    }
    EXPECT_EQ(get<std::uint32_t>(saved, 111), 3U); // of return 1
    EXPECT_NEAR(get<double>(saved, 179), 431299, 1e-7);
    EXPECT_NEAR(get<double>(saved, 187), 431234.125, 1e-7);
    // And it is patched as any other.
    EXPECT_EQ(written(back, {back.positions, {}}, "again.las"), saved);
}

TEST(LasWriter, keeps_columns_without_a_place_as_extra_bytes) {
    const PointCloud cloud =
        read_bytes(ply_header + ply_double_xyz +
                   "property float nx\nproperty float ny\nproperty float nz\nproperty float intensity\n"
                   "property int label\nproperty list uchar int seen\nproperty uchar return_number\n"
                   "property double quality_of_the_measurement_in_percent\nend_header\n"
                   "1 2 3 0 0 1 0.5 -7 2 1 2 9 0.1\n4 5 6 0 1 0 0.25 8 0 10 0.2\n7 8 9 1 0 0 1 9 0 11 0.3\n");
    std::vector<std::string> heard;
    const std::string saved = written(cloud, {}, "out.las", &heard);
    const std::string words = joined(heard);
    EXPECT_NE(words.find("'seen' is left out"), std::string::npos) << words;
    EXPECT_NE(words.find("'intensity' becomes extra bytes"), std::string::npos) << words;
    EXPECT_NE(words.find("is called 'quality_of_the_measurement_in_pe'"), std::string::npos) << words;
    const PointCloud back = read_bytes(saved);
    EXPECT_EQ(file_kind(back).encoding, "1.4, point format 6");
    EXPECT_EQ(read_normals(back), read_normals(cloud));
    EXPECT_EQ(value_of(back, "intensity_2", 1), 0.25);
    EXPECT_EQ(value_of(back, "label", 0), -7);
    EXPECT_EQ(value_of(back, "return_number", 2), 11);
    EXPECT_EQ(value_of(back, "quality_of_the_measurement_in_pe", 2), 0.3);
    EXPECT_EQ(get<std::uint64_t>(saved, 255 + 8 * 10), 1U); // of return 11
}

TEST(LasWriter, counts_returns_by_their_own_place_only) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 1, 1});
    add_attribute(cloud, "return_number", std::vector<float>{2, 300}); // no return numbers
    const std::string bytes = written(cloud, {}, "out.las");
    const auto count = [&](std::size_t number) {
        return load_little<std::uint64_t>(std::as_bytes(std::span(bytes)),
                                          las_at::points_by_return + 8 * (number - 1));
    };
    EXPECT_EQ(count(1), 2U) << "as the points say";
    EXPECT_EQ(count(2), 0U);
    const PointCloud back = read_bytes(bytes, "out.las");
    EXPECT_EQ(value_at(back.attributes[find_attribute(back, "return_number").value()], 1), 1);
    EXPECT_EQ(value_at(back.attributes[find_attribute(back, "return_number_2").value()], 1), 300);
}

TEST(LasWriter, counts_all_fifteen_returns_of_wide_points_which_tell_their_system_as_wkt) {
    const std::string saved = written(read_bytes(ply_header + ply_double_xyz +
                                                 "property uchar return_number\nend_header\n"
                                                 "0 0 0 15\n1 0 0 1\n2 0 0 15\n"),
                                      {}, "out.las");
    ASSERT_EQ(file_kind(read_bytes(saved)).encoding, "1.4, point format 6");
    EXPECT_EQ(get<std::uint64_t>(saved, 255), 1U);
    EXPECT_EQ(get<std::uint64_t>(saved, 255 + 8 * 14), 2U);
    EXPECT_EQ(get<std::uint16_t>(saved, 6), 16U);
}

TEST(LasWriter, makes_a_new_file_in_a_pose) {
    const PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 2, 3});
    const std::vector<float> far{7, 8};
    const PointCloud back =
        read_bytes(written(cloud, {moved(cloud, 1, {0.5F, 0, 0}), {}, {{"far", far}}}, "out.las"));
    EXPECT_EQ(back.file_position(1), Vec3d(1.5, 2, 3));
    EXPECT_EQ(back.file_position(0), Vec3d(0, 0, 0));
    EXPECT_EQ(value_of(back, "far", 1), 8);
    EXPECT_EQ(read_bytes(written(make_cloud({}), {}, "none.las")).size(), 0U);
}

TEST(LasWriter, finds_steps_for_clouds_of_any_size_and_place) {
    for (const double size : {1e-9, 1e-3, 1.0, 1e6, 1e12, 1e30})
        for (const double place : {0.0, 1.0, 5.4e6, -1e12}) {
            SCOPED_TRACE(testing::Message() << size << " at " << place);
            std::ostringstream text;
            text << std::setprecision(17) << ply_header << ply_double_xyz << "end_header\n";
            for (const double x : {place - size, place, place + size}) text << x << ' ' << place << " 0\n";
            const PointCloud cloud = read_bytes(text.str());
            const PointCloud back = read_bytes(written(cloud, {}, "out.las"));
            const double step = std::max(size * 1e-8, std::abs(place) * 1e-14);
            for (std::size_t i = 0; i < 3; ++i)
                EXPECT_LE((back.file_position(i) - cloud.file_position(i)).cwiseAbs().maxCoeff(), step);
        }
}

// Found by fuzzing: the search for steps never ended.
TEST(LasWriter, takes_points_next_to_each_other_for_one_place_and_refuses_points_beyond_all_bounds) {
    const auto cloud_of = [](const std::string& x) {
        return read_bytes(std::string(ply_header) + ply_double_xyz + "end_header\n-" + x + " 0 0\n" + x +
                          " 0 0\n0 0 0\n");
    };
    EXPECT_EQ(read_bytes(written(cloud_of("1e-315"), {}, "out.las")).size(), 3U);
    for (const char* x : {"1e291", "1.5e308"})
        EXPECT_NE(refusal_to_write(cloud_of(x), {}, "out.las").find("too far apart"), std::string::npos) << x;
}

TEST(LasWriter, refuses_a_new_file_of_points_that_are_not_finite) {
    const PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, std::nanf(""), 3});
    EXPECT_NE(refusal_to_write(cloud, {}, "out.las").find("point 1 has a coordinate that is not finite"),
              std::string::npos);
}

TEST(LasWriter, comes_back_from_ply_and_says_what_ply_does_not_hold) {
    LasKind kind;
    kind.minor = 4;
    kind.format = 8;
    kind.records = 2;
    kind.extra = {{"serial", 7}, {"my column", 9}};
    const PointCloud cloud = read_bytes(las_sample(kind));
    std::vector<std::string> heard;
    const PointCloud ply = read_bytes(written(cloud, {}, "out.ply", &heard));
    const std::string words = joined(heard);
    EXPECT_NE(words.find("out.ply: the column serial is of type uint64"), std::string::npos) << words;
    EXPECT_NE(words.find("'my column' is called 'my_column'"), std::string::npos) << words;
    EXPECT_NE(words.find("2 variable length records"), std::string::npos) << words;
    const PointCloud back = read_bytes(written(ply, {}, "back.las"));
    ASSERT_EQ(file_kind(back).encoding, "1.4, point format 8");
    for (const Attribute& attribute : ply.attributes)
        for (std::size_t i = 0; i < 5; ++i)
            EXPECT_NEAR(value_of(back, attribute.name, i),
                        value_of(cloud, attribute.name == "my_column" ? "my column" : attribute.name, i),
                        attribute.name.size() == 1 ? 1e-9 : 0)
                << attribute.name;
}

} // namespace
} // namespace knead::test

#include "base/error.h"
#include "io/las.h"
#include "io/las_samples.h"
#include "support/scans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>

namespace knead::test {
namespace {

double value_of(const PointCloud& cloud, std::string_view name, std::size_t point) {
    const auto column = find_attribute(cloud, name);
    return column ? value_at(cloud.attributes[*column], point) : std::nan("");
}

ScalarType type_of(const PointCloud& cloud, std::string_view name) {
    return cloud.attributes[find_attribute(cloud, name).value()].type;
}

TEST(LasReader, reads_every_version_and_point_format) {
    for (const LasKind& kind : all_las_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read_bytes(las_sample(kind));
        ASSERT_EQ(cloud.size(), 5U);
        EXPECT_EQ(file_kind(cloud).format, "las");
        EXPECT_EQ(file_kind(cloud).encoding,
                  "1." + std::to_string(kind.minor) + ", point format " + std::to_string(kind.format));
        for (std::size_t i = 0; i < 5; ++i) {
            const auto n = static_cast<double>(i);
            EXPECT_EQ(cloud.file_position(i),
                      Vec3d((100 + 7 * n) * 0.01, (-50 + n) * 0.01, (3 * n * n) * 0.01));
            EXPECT_EQ(value_of(cloud, "intensity", i), 1000 + n);
            EXPECT_EQ(value_of(cloud, "return_number", i), 1);
            EXPECT_EQ(value_of(cloud, "number_of_returns", i), 2);
            EXPECT_EQ(value_of(cloud, "classification", i), n);
            EXPECT_EQ(value_of(cloud, "synthetic", i), 1);
            EXPECT_EQ(value_of(cloud, "withheld", i), 0);
            EXPECT_EQ(value_of(cloud, "scan_direction", i), kind.format >= 6 ? 1 : 0);
        }
    }
}

// Which formats have which dimensions (LAS 1.4, tables 7 to 16), and where their last one lies.
TEST(LasReader, finds_the_dimensions_of_each_format) {
    for (unsigned format = 0; format <= 10; ++format) {
        SCOPED_TRACE(format);
        LasKind kind;
        kind.minor = 4;
        kind.format = format;
        std::string bytes = las_sample(kind);
        const std::size_t begin = las_points_begin(kind), length = las_length(kind);
        const auto has = [&](const char* name, std::initializer_list<unsigned> formats, std::size_t at,
                             auto mark) {
            const bool expected = std::find(formats.begin(), formats.end(), format) != formats.end();
            if (expected) put(bytes, begin + length + at, mark); // of point 1
            const PointCloud cloud = read_bytes(bytes);
            EXPECT_EQ(find_attribute(cloud, name).has_value(), expected) << name;
            if (!expected) return;
            EXPECT_EQ(value_of(cloud, name, 1), static_cast<double>(mark)) << name;
        };
        const bool wide = format >= 6;
        has("gps_time", {1, 3, 4, 5, 6, 7, 8, 9, 10}, wide ? 22 : 20, 12345.678);
        const std::size_t colours = wide ? 30 : format == 2 ? 20 : 28;
        has("red", {2, 3, 5, 7, 8, 10}, colours, std::uint16_t{40001});
        has("blue", {2, 3, 5, 7, 8, 10}, colours + 4, std::uint16_t{40003});
        has("nir", {8, 10}, 36, std::uint16_t{40004});
        const std::map<unsigned, std::size_t> waves = {{4, 28}, {5, 34}, {9, 30}, {10, 38}};
        const std::size_t wave = waves.contains(format) ? waves.at(format) : 0;
        has("waveform_index", {4, 5, 9, 10}, wave, std::uint8_t{7});
        has("waveform_offset", {4, 5, 9, 10}, wave + 1, std::uint64_t{1} << 40U);
        has("waveform_dz", {4, 5, 9, 10}, wave + 25, 0.25F);
        has("scan_angle_rank", {0, 1, 2, 3, 4, 5}, 16, std::int8_t{-90});
        has("scan_angle", {6, 7, 8, 9, 10}, 18, std::int16_t{-30000});
        has("point_source_id", {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}, wide ? 20 : 18, std::uint16_t{65535});
    }
}

TEST(LasReader, reads_extra_bytes_by_their_types) {
    const LasKind kind = all_las_kinds().back();
    const PointCloud cloud = read_bytes(las_sample(kind));
    const ScalarType types[] = {
        ScalarType::uint8, ScalarType::int8,   ScalarType::uint16, ScalarType::int16,   ScalarType::uint32,
        ScalarType::int32, ScalarType::uint64, ScalarType::int64,  ScalarType::float32, ScalarType::float64};
    for (unsigned type = 1; type <= 10; ++type) {
        const std::string name = "extra " + std::to_string(type);
        EXPECT_EQ(type_of(cloud, name), types[type - 1]) << name;
        EXPECT_EQ(value_of(cloud, name, 4), 4) << name;
    }
    EXPECT_EQ(type_of(cloud, "scaled"), ScalarType::float64);
    EXPECT_EQ(value_of(cloud, "scaled", 4), 4 * 0.5 + 10);
    EXPECT_EQ(value_of(cloud, "pair_1", 4), 8);
    EXPECT_FALSE(find_attribute(cloud, "secret").has_value());
    ASSERT_TRUE(find_normals(cloud).has_value());
    EXPECT_EQ(value_of(cloud, "normal_z", 4), 12);
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_NE(cloud.remarks[0].find("1 bytes that the file does not describe"), std::string::npos);
}

TEST(LasReader, gives_names_that_are_taken_a_number) {
    LasKind kind;
    kind.extra = {{"intensity", 9}, {"", 9}, {"x", 9}, {"\x1B[31m\n", 9}};
    const PointCloud cloud = read_bytes(las_sample(kind));
    for (const char* name : {"intensity_2", "extra_1", "x_2", "_[31m_"})
        EXPECT_TRUE(find_attribute(cloud, name).has_value()) << name;
}

TEST(LasReader, takes_a_file_of_no_points) {
    LasKind kind;
    kind.points = 0;
    kind.scale = {0, 0, 0};
    EXPECT_EQ(read_bytes(las_sample(kind)).size(), 0U);
}

TEST(LasReader, takes_the_old_count_where_the_wide_one_was_left_out) {
    LasKind kind;
    kind.minor = 4;
    std::string bytes = las_sample(kind);
    put(bytes, 247, std::uint64_t{0});
    EXPECT_EQ(read_bytes(bytes).size(), 5U);
}

TEST(LasReader, tells_of_counts_that_disagree) {
    LasKind kind;
    kind.minor = 4;
    std::string bytes = las_sample(kind);
    EXPECT_TRUE(read_bytes(bytes).remarks.empty());
    put(bytes, 107, std::uint32_t{9});
    const PointCloud cloud = read_bytes(bytes);
    EXPECT_EQ(cloud.size(), 5U);
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_NE(cloud.remarks[0].find("9 points in the old place and of 5"), std::string::npos)
        << cloud.remarks[0];
}

TEST(LasReader, names_compressed_files_and_the_cure) {
    std::string bytes = las_sample({});
    bytes[104] = static_cast<char>(0x80);
    EXPECT_NE(refusal(bytes, "cloud.laz").find("cloud.laz: is LAZ"), std::string::npos);
    EXPECT_NE(refusal(bytes).find("laszip -i"), std::string::npos);
    LasKind kind;
    kind.records = 1;
    bytes = las_sample(kind);
    bytes.replace(227 + 2, 16, std::string("laszip encoded\0\0", 16));
    put(bytes, 227 + 18, std::uint16_t{22204});
    EXPECT_NE(refusal(bytes).find("is LAZ"), std::string::npos);
}

TEST(LasReader, refuses_what_lies_with_place_and_cure) {
    LasKind kind;
    kind.minor = 4;
    kind.format = 7;
    kind.records = 1;
    kind.extended = 1;
    kind.extra = {{"far", 9}};
    const std::string good = las_sample(kind);
    ASSERT_EQ(refusal(good), "");
    const auto lie = [&](std::size_t at, auto value) {
        std::string bytes = good;
        put(bytes, at, value);
        return refusal(bytes);
    };
    const std::map<std::string, std::string> words = {
        {lie(24, std::uint8_t{2}), "byte 24: is LAS 2.4"},
        {lie(25, std::uint8_t{5}), "LAS 1.5"},
        {lie(94, std::uint16_t{227}), "byte 94"},
        {lie(94, std::uint16_t{65535}), "ends within its header"},
        {lie(96, std::uint32_t{0}), "byte 96"},
        {lie(96, std::uint32_t{0xFFFFFFFF}), "byte 96"},
        {lie(100, std::uint32_t{0xFFFFFFFF}), "4294967295 variable length records"},
        {lie(100, std::uint32_t{3}), "a variable length record begins where none fits"},
        {lie(104, std::uint8_t{11}), "format 11"},
        {lie(105, std::uint16_t{39}), "reach beyond the end of a point"},
        {lie(105, std::uint16_t{35}), "has at least 36"},
        {lie(105, std::uint16_t{0}), "has at least 36"},
        {lie(131, 0.0), "the scale of x is 0"},
        {lie(139, std::nan("")), "the scale of y"},
        {lie(171, std::numeric_limits<double>::infinity()), "the offset of z"},
        {lie(235, std::uint64_t{0}), "byte 235"},
        {lie(235, ~std::uint64_t{0}), "byte 235"},
        {lie(243, std::uint32_t{2}), "byte 235"},
        {lie(247, std::uint64_t{8}), "promises 8 points"},
        {lie(247, ~std::uint64_t{0}), "byte 247"},
        {lie(375 + 20, std::uint16_t{60000}), "byte 375: a variable length record of 60000 bytes"},
        {lie(good.size() - 40, ~std::uint64_t{0}), "reaches beyond the end of the file"},
        {lie(375 + 54 + 54 + 2, std::uint8_t{31}), "of type 31"},
    };
    for (const auto& [said, expected] : words) EXPECT_NE(said.find(expected), std::string::npos) << said;
}

TEST(LasReader, never_falls_over_a_file_that_is_cut_off_or_overwritten) {
    LasKind kind = all_las_kinds().back();
    const std::string whole = las_sample(kind);
    EXPECT_TRUE(is_taken(whole, read_las));
    for (std::size_t size = 4; size < whole.size(); ++size)
        EXPECT_FALSE(is_taken(whole.substr(0, size), read_las)) << size;
    std::size_t taken = 0;
    for (std::size_t at = 4; at < las_points_begin(kind); ++at)
        for (const char value : {'\0', '\x7F', '\xFF'}) {
            std::string bytes = whole;
            bytes[at] = value;
            taken += is_taken(bytes, read_las) ? 1U : 0U;
        }
    EXPECT_GT(taken, 0U); // names, descriptions, dates
}

TEST(LasReader, opens_the_shared_files_and_refuses_the_bad_ones) {
    for (const char* name : {"odd/pdal_bad_vlr_count.las", "odd/pdal_garbage_nVariableLength.las"}) {
        KNEAD_SAMPLE_OR_SKIP(path, name);
        EXPECT_NE(refusal(read_text(path)).find("variable length record"), std::string::npos) << name;
    }
    const std::map<std::string, std::size_t> points = {{"odd/pdal_1.2-empty-geotiff-vlrs.las", 43},
                                                       {"odd/pdal_gps-time-nan.las", 1},
                                                       {"odd/pdal_lots_of_vlr.las", 1},
                                                       {"odd/pdal_no-points.las", 0},
                                                       {"odd/pdal_noise-dirty.las", 1065},
                                                       {"odd/pdal_spurious.las", 1065},
                                                       {"plain/1_4_w_evlr.las", 1000},
                                                       {"plain/extrabytes.las", 1065},
                                                       {"plain/lion_tile_rgb.las", 1588},
                                                       {"plain/point-color-time.las", 1065},
                                                       {"plain/test1_4.las", 1000}};
    for (const auto& [name, expected] : points) {
        KNEAD_SAMPLE_OR_SKIP(path, name);
        const std::string bytes = read_text(path);
        const PointCloud cloud = read_bytes(bytes);
        EXPECT_EQ(cloud.size(), expected) << name;
        EXPECT_EQ(written(cloud, {}, "out.las"), bytes) << name;
        EXPECT_EQ(written(cloud, {cloud.positions, read_normals(cloud)}, "out.las"), bytes) << name;
    }
}

// Values that PDAL's own tests expect of its file extrabytes.las (LasReaderTest, extraBytes).
TEST(LasReader, reads_the_extra_bytes_of_a_real_file) {
    KNEAD_SAMPLE_OR_SKIP(path, "plain/extrabytes.las");
    const PointCloud cloud = read_bytes(read_text(path));
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(value_of(cloud, "Colors_0", i), value_of(cloud, "red", i));
        EXPECT_EQ(value_of(cloud, "Colors_1", i), value_of(cloud, "green", i));
        EXPECT_EQ(value_of(cloud, "Colors_2", i), value_of(cloud, "blue", i));
        EXPECT_EQ(value_of(cloud, "Time", i), std::floor(value_of(cloud, "gps_time", i)));
    }
}

} // namespace
} // namespace knead::test

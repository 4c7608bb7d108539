#include "base/error.h"
#include "io/ply.h"
#include "io/ply_samples.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <map>

namespace knead::test {
namespace {

const std::string ascii_xyz = "property float x\nproperty float y\nproperty float z\nend_header\n";

std::string ascii_cloud(const std::string& count, const std::string& rows) {
    return "ply\nformat ascii 1.0\nelement vertex " + count + "\n" + ascii_xyz + rows;
}

TEST(PlyReader, reads_the_same_points_from_every_kind_of_file) {
    for (const SampleKind& kind : all_sample_kinds()) {
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read_bytes(sample(kind));
        ASSERT_EQ(cloud.size(), sample_points);
        EXPECT_TRUE(cloud.remarks.empty());
        EXPECT_EQ(cloud.origin, Vec3d(12, 18, 30.5));
        const Attribute& red = cloud.attributes[find_attribute(cloud, "red").value()];
        for (std::size_t i = 0; i < sample_points; ++i) {
            const auto at = static_cast<double>(i);
            EXPECT_EQ(cloud.file_position(i), Vec3d(10 + at, 20 - at, static_cast<double>(30 + i % 2)));
            EXPECT_EQ(value_at(red, i), 7 * at);
        }
        EXPECT_EQ(cloud.attributes[0].type, kind.coordinates);
        EXPECT_EQ(file_kind(cloud).encoding, knead::name_of(kind.encoding));
    }
}

TEST(PlyReader, reads_lists_of_points) {
    for (const SampleKind& kind : all_sample_kinds()) {
        if (!kind.lists) continue;
        SCOPED_TRACE(name_of(kind));
        const PointCloud cloud = read_bytes(sample(kind));
        const Attribute& seen = cloud.attributes[find_attribute(cloud, "seen").value()];
        EXPECT_EQ(seen.type, ScalarType::int16);
        EXPECT_EQ(seen.count_type, ScalarType::uint8);
        EXPECT_EQ(seen.first, (std::vector<std::uint64_t>{0, 0, 1, 3, 6, 10}));
        const std::vector<double> expected{1, 2, 3, 3, 4, 5, 4, 5, 6, 7};
        for (std::size_t k = 0; k < expected.size(); ++k) EXPECT_EQ(value_at(seen, k), expected[k]);
    }
}

TEST(PlyReader, understands_numbers_as_programs_write_them) {
    const PointCloud cloud =
        read_bytes("ply\nformat ascii 1.0\nelement vertex 3\n"
                   "property double x\nproperty double y\nproperty double z\nproperty uchar red\nend_header\n"
                   "+1.5 -2E-3 .25 255.0\n\n  1.#INF -1.#IND\tnan 0\n 1 2 -inf +7  \n\n");
    EXPECT_EQ(cloud.file_position(0), Vec3d(1.5, -0.002, 0.25));
    EXPECT_EQ(value_at(cloud.attributes[3], 0), 255);
    EXPECT_EQ(cloud.file_position(1)[0], std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isnan(cloud.file_position(1)[1]));
    EXPECT_TRUE(std::isnan(cloud.file_position(1)[2]));
    EXPECT_EQ(cloud.file_position(2)[2], -std::numeric_limits<double>::infinity());
    EXPECT_EQ(value_at(cloud.attributes[3], 2), 7);
    EXPECT_FALSE(is_finite(cloud, 1));
    ASSERT_EQ(cloud.remarks.size(), 1U) << "two points that are not finite are worth a word";
    EXPECT_NE(cloud.remarks[0].find("2 of 3 points"), std::string::npos);
}

TEST(PlyReader, refuses_a_number_with_two_signs) {
    for (const char* number : {"+-5", "-+5", "++5", "--5"})
        EXPECT_THROW(
            read_bytes("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                       "property float z\nend_header\n" +
                       std::string(number) + " 0 0\n"),
            Error)
            << number;
}

TEST(PlyReader, takes_a_list_that_was_never_written_as_empty) {
    const std::string file = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n"
                             "property float z\nproperty list uchar int faces\nend_header\n1 2 3\n4 5 6\n";
    const PointCloud cloud = read_bytes(file);
    EXPECT_EQ(cloud.attributes[3].first, (std::vector<std::uint64_t>{0, 0, 0}));
    EXPECT_EQ(written(cloud, {}), file);
    const std::vector<float> moved(6, 1.0F);
    EXPECT_EQ(read_bytes(written(cloud, {moved, {}})).size(), 2U);
}

TEST(PlyReader, opens_a_file_of_no_points) {
    const PointCloud cloud = read_bytes(ascii_cloud("0", ""));
    EXPECT_EQ(cloud.size(), 0U);
    EXPECT_EQ(cloud.attributes.size(), 3U);
    EXPECT_EQ(bounds_of(cloud).finite_points, 0U);
}

TEST(PlyReader, remarks_on_bytes_behind_the_last_element) {
    for (const SampleKind& kind : all_sample_kinds()) {
        const PointCloud cloud = read_bytes(sample(kind) + "more");
        ASSERT_EQ(cloud.remarks.size(), 1U) << name_of(kind);
        EXPECT_EQ(cloud.remarks[0], "4 bytes follow the last element; they are kept as they are");
        EXPECT_EQ(written(cloud, {}), sample(kind) + "more");
    }
}

TEST(PlyReader, remarks_on_floats_far_from_the_origin) {
    const std::string rows = "512840 5403000 100\n512940 5403100 120\n";
    const PointCloud cloud = read_bytes(ascii_cloud("2", rows));
    ASSERT_EQ(cloud.remarks.size(), 1U);
    EXPECT_NE(cloud.remarks[0].find("a grid of 0.5"), std::string::npos) << cloud.remarks[0];
    std::string doubles = ascii_cloud("2", rows);
    for (std::size_t at = doubles.find("float"); at != std::string::npos; at = doubles.find("float"))
        doubles.replace(at, 5, "double");
    EXPECT_TRUE(read_bytes(doubles).remarks.empty());
}

// --- Refusals ----------------------------------------------------------------------------------------------

TEST(PlyReader, refuses_bad_headers_by_file_and_line) {
    const std::string start = "ply\nformat ascii 1.0\n";
    const std::map<std::string, std::string> words = {
        {"ply\nformat ascii\n", "cloud.ply:2: a format line"},
        {"ply\nformat ascii 2.0\n", "cloud.ply:2: PLY version '2.0'"},
        {"ply\nformat binary 1.0\n", "cloud.ply:2: unknown encoding 'binary'"},
        {start + "format ascii 1.0\n", "cloud.ply:3: a second format line"},
        {"ply\nelement vertex 1\n" + ascii_xyz + "1 2 3\n", "cloud.ply:6: the header has no format"},
        {start + "element vertex\n", "cloud.ply:3: an element line"},
        {start + "element vertex -1\n", "cloud.ply:3: the count '-1'"},
        {start + "element vertex 1.5\n", "cloud.ply:3: the count '1.5'"},
        {start + "element vertex 99999999999999999999\n", "cloud.ply:3: the count"},
        {start + "element vertex 1\nelement vertex 1\n", "cloud.ply:4: a second element vertex"},
        {start + "element vertex 1\nproperty float128 x\n", "cloud.ply:4: unknown type 'float128'"},
        {start + "element vertex 1\nproperty float x\nproperty int x\n", "cloud.ply:5: element 'vertex'"},
        {start + "element vertex 1\nproperty list float int x\n", "cloud.ply:4: a list's length"},
        {start + "property float x\n", "cloud.ply:3: a property before any element"},
        {start + "element vertex 1\nproperty float a\x1B[2J\n",
         "cloud.ply:4: the name 'a?[2J' has a control"},
        {"ply\rformat ascii 1.0\relement a\nb 1\r", "cloud.ply:3: the name 'a?b' has a control"},
        {start + "elemnt vertex 1\n", "cloud.ply:3: unknown header line 'elemnt'"},
        {start + "element vertex 1\nproperty float x\n", "cloud.ply:4: the header has no end_header"},
        {start + "end_header\n", "cloud.ply: its header has no element vertex"},
        {start + "element vertex 0\nproperty float x\nproperty float y\nend_header\n",
         "cloud.ply:3: the element vertex has no property z"},
        {start + "element vertex 0\nproperty float x\nproperty list uchar float y\nproperty float z\n"
                 "end_header\n",
         "cloud.ply:3: the property y is a list"},
    };
    for (const auto& [bytes, expected] : words)
        EXPECT_EQ(refusal(bytes).substr(0, expected.size()), expected) << bytes;
}

TEST(PlyReader, refuses_bad_rows_by_file_and_line) {
    const std::map<std::string, std::string> words = {
        {"1.0 2.0 3.0\n4.0 5.0\n", "cloud.ply:9: vertex row 1 ends before the property 'z'"},
        {"1 2 3 4\n4 5 6\n",
         "cloud.ply:8: vertex row 0 has more numbers than the header has properties, from '4'"},
        {"1.0 2.0 3.0\n", "cloud.ply:8: vertex row 1 is missing"},
        {"1 2 3\n4 five 6\n",
         "cloud.ply:9: vertex row 1 has 'five' for the property 'y', which is no float32"},
        {"1 2 3\n4 5.6.7 6\n", "cloud.ply:9: vertex row 1 has '5.6.7' for the property 'y'"},
    };
    for (const auto& [rows, expected] : words)
        EXPECT_EQ(refusal(ascii_cloud("2", rows)).substr(0, expected.size()), expected);
    const std::string colour = "ply\nformat ascii 1.0\nelement vertex 1\nproperty uchar red\n" + ascii_xyz;
    for (const char* red : {"256", "-1", "0.5", "nan", "1e99"})
        EXPECT_NE(refusal(colour + red + " 1 2 3\n").find("which is no uint8"), std::string::npos) << red;
    const std::string list = "ply\nformat ascii 1.0\nelement vertex 1\nproperty list int int l\n" + ascii_xyz;
    EXPECT_NE(refusal(list + "-1 1 2 3\n").find("of the length '-1'"), std::string::npos);
    EXPECT_NE(refusal(list + "9223372036854775808.0 1 2 3\n").find("of the length '9223372036854775808.0'"),
              std::string::npos);
    EXPECT_NE(refusal(list + "4000000000000000000 1 2 3\n").find("ends before the property 'l'"),
              std::string::npos);
}

TEST(PlyReader, believes_no_count_that_the_file_cannot_hold) {
    for (const char* encoding : {"ascii", "binary_little_endian", "binary_big_endian"})
        for (const char* count : {"99999999999", "18446744073709551615", "4294967295", "1000000000"}) {
            const std::string start = std::string("ply\nformat ") + encoding + " 1.0\n";
            const std::string vertices = std::string("element vertex ") + count + "\n" + ascii_xyz;
            EXPECT_FALSE(refusal(start + vertices + std::string(36, '\0')).empty());
            const std::string faces = std::string("element face ") + count + "\nproperty list uchar int v\n";
            EXPECT_FALSE(
                refusal(start + faces + "element vertex 1\n" + ascii_xyz + std::string(36, '\0')).empty());
        }
}

TEST(PlyReader, believes_no_list_that_the_file_cannot_hold) {
    const std::string header = "ply\nformat binary_little_endian 1.0\nelement vertex 1\n"
                               "property float x\nproperty float y\nproperty float z\n";
    const std::string point(12, '\0');
    EXPECT_NE(refusal(header + "property list int double l\nend_header\n" + point + "\xFF\xFF\xFF\x7F....")
                  .find("of the length 2147483647"),
              std::string::npos);
    EXPECT_NE(refusal(header + "property list int double l\nend_header\n" + point + "\xFF\xFF\xFF\xFF....")
                  .find("of the length -1"),
              std::string::npos);
}

// The header of an element without properties may promise anything: nothing is written for its rows.
TEST(PlyReader, passes_over_an_element_without_properties) {
    EXPECT_EQ(read_bytes("ply\nformat ascii 1.0\nelement nothing 18446744073709551615\nelement vertex 1\n" +
                         ascii_xyz + "1 2 3\n")
                  .size(),
              1U);
}

TEST(PlyReader, opens_headers_of_very_many_lines) {
    constexpr std::size_t many = 200'000;
    std::string bytes = "ply\nformat ascii 1.0\n";
    for (std::size_t i = 0; i < many; ++i) bytes += "element e" + std::to_string(i) + " 0\n";
    bytes += "element vertex 0\n";
    for (std::size_t i = 0; i < many; ++i) bytes += "property char p" + std::to_string(i) + "\n";
    EXPECT_EQ(read_bytes(bytes + ascii_xyz).attributes.size(), many + 3);
}

TEST(PlyReader, names_other_formats_and_says_what_to_do) {
    using namespace std::string_literals;
    const std::map<std::string, std::string> words = {
        {"", "is empty"},
        {"\xEF\xBB\xBFply\nformat ascii 1.0\n", "byte-order mark"},
        {"\xFF\xFEp\0l\0y\0"s, "UTF-16"},
        {R"({"knead":1})", "is a knead session, not a cloud"},
        {"PLY\nformat", "'ply' alone"},
        {"plywood\n", "stand alone"},
    };
    for (const auto& [bytes, expected] : words)
        EXPECT_NE(refusal(bytes).find(expected), std::string::npos) << bytes << ": " << refusal(bytes);
}

TEST(PlyReader, refuses_what_is_no_file) {
    const ScratchFolder folder;
    SilentProgress progress;
    EXPECT_THROW(read_cloud(folder / "missing.ply", progress), Error);
    EXPECT_THROW(read_cloud(folder.path(), progress), Error);
}

TEST(PlyReader, never_falls_over_a_file_that_is_cut_off) {
    for (const SampleKind& kind : all_sample_kinds()) {
        if (kind.coordinates != ScalarType::float32 || kind.line_end == "\r") continue;
        const std::string whole = sample(kind);
        for (std::size_t size = 0; size < whole.size(); ++size) {
            const bool loads = is_taken(whole.substr(0, size), read_ply);
            // Only a text may lack its last line's end, its last blank and the rest of its last number.
            const bool may_load = kind.encoding == PlyEncoding::ascii && size + 4 >= whole.size();
            EXPECT_TRUE(may_load || !loads) << name_of(kind) << " cut to " << size;
        }
    }
}

// Whatever the bytes, a file is refused with words or opened; sanitizers watch.
TEST(PlyReader, never_falls_over_a_damaged_byte) {
    for (const auto encoding : {PlyEncoding::ascii, PlyEncoding::binary_big_endian}) {
        const std::string whole = sample({encoding, ScalarType::float32, true, true, "\n"});
        for (std::size_t at = 0; at < whole.size(); ++at)
            for (const char damage : {'\0', '\n', '9', '-', '\xFF'}) {
                std::string bytes = whole;
                bytes[at] = damage;
                (void)is_taken(bytes, read_ply);
            }
    }
}

} // namespace
} // namespace knead::test

// OFF: its vertices as points, and faces kept.

#include "base/error.h"
#include "io/off.h"
#include "io/through_files.h"

#include <gtest/gtest.h>

#include <map>

namespace knead::test {
namespace {

PointCloud read_off_text(std::string_view text) {
    return read_bytes(text, "cloud.off");
}

std::string saved(const PointCloud& cloud, const PosedShape& shape) {
    return written(cloud, shape, "out.off");
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
    return text.replace(text.find(from), from.size(), to);
}

const Attribute& column(const PointCloud& cloud, std::string_view name) {
    return cloud.attributes[find_attribute(cloud, name).value()];
}

const std::string rows = "0 0 0\n1.50 0 0 # a word\n\n0 1 0\r\n0 0 1";
const std::string faces = "\n3 0 1 2\n3 0 1 3 255 0 0\n# the end\n";

TEST(Off, ReadsHeadersInEverySpelling) {
    for (const char* header : {"OFF\n4 2 6\n", "OFF 4 2 6\n", "OFF4 2 6\n", "# words\nOFF # words\n\n4 2 0\n",
                               "OFF\r\n4 2 6\r\n", "OFF\n4 2\n", "\xEF\xBB\xBFOFF\n4 2 6\n"}) {
        const std::string text = header + rows + faces;
        const PointCloud cloud = read_off_text(text);
        ASSERT_EQ(cloud.size(), 4U) << header;
        EXPECT_EQ(cloud.file_position(1), Vec3d(1.5, 0, 0));
        EXPECT_TRUE(cloud.remarks.empty()) << joined(cloud.remarks);
        EXPECT_EQ(saved(cloud, {}), text);
        std::vector<float> posed = cloud.positions;
        posed[3] += 0.25F;
        posed[11] += 1;
        EXPECT_EQ(saved(cloud, {posed, {}}),
                  replaced(replaced(text, "1.50", "1.75"), "0 0 1\n3", "0 0 2\n3"));
        EXPECT_EQ(cloud.image->besides_points(), std::vector<std::string>{"2 faces"});
    }
}

TEST(Off, MayLackItsKeywordWhereItsNameTellsIt) {
    const std::string text = "# words\n4 2 6\n" + rows + faces;
    const PointCloud cloud = read_off_text(text);
    ASSERT_EQ(cloud.size(), 4U);
    EXPECT_EQ(file_kind(cloud).format, "off");
    EXPECT_EQ(saved(cloud, {}), text);
    EXPECT_EQ(file_kind(read_bytes("1 2 3\n4 5 6\n", "cloud.xyz")).format, "xyz");
}

TEST(Off, ReadsWhatItsKeywordSays) {
    const std::string text =
        "STCNOFF\n2 0 0\n1 2 3  0 0 1  255 0 10 128  0.25 0.5\n4 5 6  0 1 0  0 1 2 3  0 1\n";
    const PointCloud cloud = read_off_text(text);
    EXPECT_EQ(cloud.file_position(1), Vec3d(4, 5, 6));
    EXPECT_EQ(read_normals(cloud), (std::vector<float>{0, 0, 1, 0, 1, 0}));
    EXPECT_EQ(column(cloud, "red").type, ScalarType::uint8);
    EXPECT_EQ(value_at(column(cloud, "alpha"), 0), 128);
    EXPECT_EQ(value_at(column(cloud, "t"), 0), 0.5);
    const std::vector<float> normals{0, 0, 1, 1, 0, 0};
    std::vector<float> posed = cloud.positions;
    posed[3] += 1;
    EXPECT_EQ(saved(cloud, {posed, normals}), replaced(text, "4 5 6  0 1 0", "5 5 6  1 0 0"));
}

TEST(Off, ColoursMayBeBytesOrFractionsWithOrWithoutAlpha) {
    const PointCloud fractions = read_off_text("COFF\n1 0 0\n1 2 3 0.5 0 1 1\n");
    EXPECT_EQ(value_at(column(fractions, "red"), 0), 0.5);
    const PointCloud ones = read_off_text("COFF\n1 0 0\n1 2 3 1 0 1\n");
    EXPECT_EQ(column(ones, "red").type, ScalarType::float32);
    EXPECT_FALSE(find_attribute(ones, "alpha"));
    EXPECT_EQ(column(read_off_text("COFF\n1 0 0\n1 2 3 2 0 1\n"), "red").type, ScalarType::uint8);
}

TEST(Off, IsKnownByItsContent) {
    EXPECT_EQ(file_kind(read_bytes("NOFF\n1 0 0\n1 2 3 0 0 1\n", "cloud.ply")).format, "off");
    EXPECT_EQ(file_kind(read_bytes("OFF1 0 0\n1 2 3\n", "cloud.ply")).format, "off");
}

TEST(Off, KeepsWhatItDoesNotUnderstand) {
    const std::string text = "OFF\n1 0 0\n1 2 3 9 9\nmore\n1 2\n";
    const PointCloud cloud = read_off_text(text);
    EXPECT_EQ(cloud.remarks.size(), 2U) << joined(cloud.remarks);
    EXPECT_EQ(saved(cloud, {}), text);
}

TEST(Off, OpensAFileOfNoPoints) {
    for (const char* text : {"OFF\n0 0 0\n", "CNOFF 0 0 0"}) {
        const PointCloud cloud = read_off_text(text);
        EXPECT_EQ(cloud.size(), 0U);
        EXPECT_EQ(saved(cloud, {}), text);
    }
}

TEST(Off, HoldsPointsColoursAndNormalsOfOtherClouds) {
    PointCloud cloud = make_cloud(std::vector<float>{0, 0, 0, 1, 2.5F, 3});
    EXPECT_EQ(saved(cloud, {}), "OFF\n2 0 0\n0 0 0\n1 2.5 3\n");
    add_attribute(cloud, "red", std::vector<std::uint8_t>{0, 255});
    add_attribute(cloud, "green", std::vector<std::uint8_t>{51, 51});
    add_attribute(cloud, "blue", std::vector<std::uint8_t>{255, 0});
    EXPECT_EQ(saved(cloud, {}), "COFF\n2 0 0\n0 0 0 0 51 255 255\n1 2.5 3 255 51 0 255\n");
    add_attribute(cloud, "nx", std::vector<float>{0, 1});
    add_attribute(cloud, "ny", std::vector<float>{0, 0});
    add_attribute(cloud, "nz", std::vector<float>{1, 0});
    add_attribute(cloud, "mass", std::vector<float>{1, 0});
    std::vector<std::string> heard;
    const std::string text = written(cloud, {}, "out.off", &heard);
    EXPECT_EQ(text, "CNOFF\n2 0 0\n0 0 0 0 0 1 0 51 255 255\n1 2.5 3 1 0 0 255 51 0 255\n");
    EXPECT_NE(joined(heard).find("'mass' is left out, since OFF"), std::string::npos) << joined(heard);
    const PointCloud back = read_off_text(text);
    EXPECT_EQ(back.positions, cloud.positions);
    EXPECT_EQ(read_normals(back), read_normals(cloud));
    PointCloud deep = make_cloud(std::vector<float>{0, 0, 0});
    for (const char* name : {"red", "green", "blue"})
        deep.attributes.push_back({name, ScalarType::uint16, {std::byte{0}, std::byte{0x80}}, {}});
    EXPECT_EQ(saved(deep, {}), "COFF\n1 0 0\n0 0 0 0.5000076 0.5000076 0.5000076 1.0\n");
}

TEST(Off, RefusesWhatIsWrongByFileAndLine) {
    const std::map<std::string, std::string> words = {
        {"OFF BINARY\n\1\2\3", "cloud.off:1: 'BINARY' OFF is not read"},
        {"4OFF\n1 0 0\n1 2 3 1\n", "cloud.off:1: '4OFF' has vertices of other than three"},
        {"nOFF\n2\n1 0 0\n1 2\n", "cloud.off:1: 'nOFF' has vertices of other than three"},
        {"OFF\n", "cloud.off: ends before its counts"},
        {"# words\n", "cloud.off: holds no counts"},
        {"# words\nOF\n", "cloud.off:2: 'OF' stands where OFF"},
        {"OFF\n1\n", "cloud.off:2: '1' is not followed by the number of faces"},
        {"OFF\n1 0 0 0\n1 2 3\n", "cloud.off:2: '1' begins a line of more than the three counts"},
        {"OFF\n-1 0 0\n", "cloud.off:2: '-1' is no count"},
        {"OFF\n99999999999999999999 0 0\n", "cloud.off:2: '99999999999999999999' is no count"},
        {"OFF\n4 0 0\n0 0 0\n", "cloud.off: promises 4 vertices and 0 faces, but only 7 bytes follow"},
        {"OFF\n1 18446744073709551615 0\n0 0 0\n", "cloud.off: promises 1 vertices"},
        {"OFF\n2 0 0\n0 0 0         \n", "cloud.off: ends before its vertex 1 of 2"},
        {"OFF\n2 0 0\n0 0 0 \n0 0  # no z\n", "cloud.off:4: '0' begins vertex 1 of 2 numbers; it needs 3"},
        {"OFF\n1 0 0\n0 0 zero\n", "cloud.off:3: 'zero' is no number"},
        {"OFF\n1 1 0\n0 0 0\n\n", "cloud.off: ends before its face 0 of 1"},
        {"OFF\n1 1 0\n0 0 0\n3 0 0\n", "cloud.off:4: '3' corners are promised"},
        {"OFF\n1 1 0\n0 0 0\n1 1\n", "cloud.off:4: '1' names a vertex that is not in the file, which has 1"},
        {"OFF\n1 1 0\n0 0 0\n1 -1\n", "cloud.off:4: '-1' is no count"},
        {"OFF\n1 1 0\n0 0 0\n18446744073709551615 0\n", "cloud.off:4: '18446744073709551615' corners"},
        {"NOFF\n1 0 0\n0 0 0 1\n", "cloud.off:3: '0' begins vertex 0 of 4 numbers; it needs 6"},
    };
    for (const auto& [bytes, expected] : words)
        EXPECT_EQ(refusal(bytes, "cloud.off").substr(0, expected.size()), expected) << bytes;
}

// Without files, since there are many.
void read_whatever(const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    SilentProgress progress;
    try {
        const PointCloud cloud = read_off({bytes.begin(), bytes.end()}, "cloud.off", progress);
        EXPECT_EQ(cloud.positions.size(), 3 * cloud.size());
    } catch (const Error& error) {
        EXPECT_EQ(error.trouble(), Trouble::input);
        EXPECT_TRUE(std::string_view(error.what()).starts_with("cloud.off:")) << error.what();
    }
}

// Whatever the bytes, a file is refused with words or opened; sanitizers watch.
TEST(Off, NeverFallsOverADamagedByte) {
    const std::string whole = "CNOFF\n2 1 0\n1 2 3 0 0 1 255 0 0\n1 2 4 0 0 1 0 0 255\n2 0 1\n";
    for (std::size_t at = 0; at < whole.size(); ++at) {
        read_whatever(whole.substr(0, at));
        for (const char damage : {'\0', '\n', '9', '-', '\\', '#', '.', '\xFF'}) {
            std::string bytes = whole;
            bytes[at] = damage;
            read_whatever(bytes);
        }
    }
}

} // namespace
} // namespace knead::test
